// Thresholds of the safety layer, changeable at run time; the defaults are a Premium 1.5 at a tick of 1 ms.
//
// Published: 8.5 N, the motors' data, warm motors from 0.7 to 0.5 of the way from ambient to the winding's
// limit and x0.999 a tick, 0.2 N for more than 3 ticks, a ramp of 2.0 s, 41 counts a tick at 1 m/s.
// Chosen here, to be set for an application: all other figures, with their reasons beside them.
#pragma once

#include "palpate/numeric/q.hpp"
#include "palpate/phantom/premium.hpp"
#include "palpate/safety/condition_set.hpp"

namespace palpate::safety {

using Gain = Q<1, 30>;     ///< of the force: 0 .. 1, both exact
using Ampere = Q<3, 28>;   ///< motor currents: +-8 A, LSB 3.7 nA
using Celsius = Q<8, 23>;  ///< motor temperatures: +-256 degC, LSB 1.2e-7 K

inline constexpr Gain kNoForce = Gain::from_raw(0);
inline constexpr Gain kFullForce = Gain::ratio(1, 1);

/// 1 / ramp_ticks rounded down, so that a ramp never rises faster than asked: where 2^30 / ramp_ticks is no
/// whole number it ends one tick later. 0 ticks: the whole force at once. Below 32768 ticks.
constexpr Gain ramp_step(uint16_t ramp_ticks) {
  return ramp_ticks == 0 ? kFullForce : Gain::from_raw(kFullForce.raw() / int32_t{ramp_ticks});
}

struct RampParameters {
  Gain step_per_tick = ramp_step(2000);
  phantom::Newton contact_newtons = phantom::Newton::ratio(2, 10);  ///< below this the hand is free
  uint16_t free_ticks = 4;  ///< so many in a row before the ramp begins: more than 3
};

struct ForceLimits {
  phantom::Newton max_newtons = phantom::Newton::ratio(85, 10);
  /// The stiffest wall of the device, 800 N/m, at max_velocity: 800 x 2 mm.
  phantom::Newton impulse_newtons_per_tick = phantom::Newton::ratio(16, 10);
  /// Over kImpulseWindowTicks: half of that on average.
  phantom::Newton impulse_newtons_per_window = phantom::Newton::ratio(64, 10);
};
inline constexpr uint32_t kImpulseWindowTicks = 8;

struct MotionLimits {
  /// 2 m/s: beyond it nodes of a body of 64 mm are clamped at one substep a tick (docs/numerics.md).
  phantom::Metre max_metres_per_tick = phantom::Metre::ratio(2, 1000);
  /// 5 m/s, which no hand on a stylus reaches: 41 counts a tick at 1 m/s.
  int32_t max_counts_per_tick = 205;
  /// Joint friction and the heavier link's weight, (0.010 + 0.074) N m / (11.2 x 0.0234 N m/A).
  Ampere moving_amperes = Ampere::ratio(32, 100);
  /// A hand trembles by more than a count in that time.
  uint16_t stuck_ticks = 1000;
};

struct TimingLimits {
  uint16_t silent_ticks = 3;   ///< communication_lost: ticks in a row without a new message
  uint16_t overrun_ticks = 3;  ///< tick_overrun: cycles in a row that were late
};

/// A motor's data as integers: the host reads the same figures.
struct ThermalRatings {
  int32_t resistance_milliohms;               ///< R at 25 degC
  int32_t copper_parts_per_million_kelvin;    ///< alpha, its growth
  int32_t winding_to_housing_milli_kelvin_w;  ///< thermal resistance, K/W / 1000
  int32_t housing_to_ambient_milli_kelvin_w;
  int32_t winding_millijoules_per_kelvin;  ///< heat capacity
  int32_t housing_millijoules_per_kelvin;
};

/// Maxon RE25 118743.
inline constexpr ThermalRatings kRe25{2180, 3930, 3100, 14000, 3870, 43700};

struct ThermalLimits {
  Celsius ambient = Celsius::ratio(25, 1);
  Celsius warm = Celsius::ratio(775, 10);     ///< above it the current limit ramps down: 25 + 0.7 x 75
  Celsius release = Celsius::ratio(625, 10);  ///< below it the limit comes back: 25 + 0.5 x 75
  Celsius winding_limit = Celsius::ratio(100, 1);
  Ampere peak_amperes = Ampere::ratio(phantom::premium::kDriveRatings.full_scale_milliamperes, 1000);
  Ampere continuous_amperes = Ampere::ratio(phantom::premium::kDriveRatings.current_limit_milliamperes, 1000);
  Q<0, 31> decay_per_tick = Q<0, 31>::ratio(999, 1000);
  /// The whole span in the time of a ramp.
  Ampere rise_amperes_per_tick = Ampere::ratio(5500 - 1240, int64_t{1000} * 2000);
};

struct Parameters {
  RampParameters ramp;
  ForceLimits force;
  MotionLimits motion;
  TimingLimits timing;
  ThermalLimits thermal;
  /// What the monitors may find and nobody hears of: for scripts without a hand, whose counts jump. What a
  /// board reports is always heard.
  ConditionSet ignored;
};

inline constexpr Parameters kPremium15Parameters{};

/// Whether every threshold is one that its monitor can keep: none negative, none 0 where that would mean
/// "always", temperatures and currents in order. The firmware refuses others as it refuses a model.
constexpr bool is_usable(const Parameters& p) {
  constexpr auto kNoNewtons = phantom::Newton::from_raw(0);
  constexpr auto kNoAmperes = Ampere::from_raw(0);
  const bool ramp = p.ramp.step_per_tick > kNoForce && p.ramp.step_per_tick <= kFullForce &&
                    p.ramp.contact_newtons > kNoNewtons;
  const bool force = p.force.max_newtons > kNoNewtons && p.force.impulse_newtons_per_tick > kNoNewtons &&
                     p.force.impulse_newtons_per_window > kNoNewtons;
  const bool motion = p.motion.max_metres_per_tick > phantom::Metre::from_raw(0) &&
                      p.motion.max_counts_per_tick > 0 && p.motion.moving_amperes >= kNoAmperes &&
                      p.motion.stuck_ticks > 0;
  const bool timing = p.timing.silent_ticks > 0 && p.timing.overrun_ticks > 0;
  const ThermalLimits& t = p.thermal;
  const bool temperatures = t.ambient >= Celsius::from_raw(0) && t.ambient < t.release &&
                            t.release < t.warm && t.warm < t.winding_limit;
  const bool currents = t.continuous_amperes > kNoAmperes && t.continuous_amperes <= t.peak_amperes &&
                        t.rise_amperes_per_tick > kNoAmperes && t.decay_per_tick > Q<0, 31>::from_raw(0);
  return ramp && force && motion && timing && temperatures && currents;
}

}  // namespace palpate::safety
