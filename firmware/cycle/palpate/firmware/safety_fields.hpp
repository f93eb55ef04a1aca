// The fields of the safety layer's parameters, each with its name and its range, once for reading, writing
// and changing one of them (settings.hpp). The order is that of the bytes and of the settings' numbers: a
// change of it is a new version of the chunk. docs/container-format.md has them as a table.
#pragma once

#include "palpate/container/field_reader.hpp"
#include "palpate/container/field_writer.hpp"
#include "palpate/safety/parameters.hpp"

namespace palpate::firmware::safety_fields {

template <class Fixed>
constexpr Fixed least_positive() {
  return Fixed::from_raw(1);
}

/// 72 bytes.
template <class Fields, class AParameters>
void thresholds(Fields& fields, AParameters& p) {
  using phantom::Metre;
  using phantom::Newton;
  using safety::Ampere;
  using safety::Celsius;
  constexpr auto kNewton = least_positive<Newton>();
  constexpr auto kAmpere = least_positive<Ampere>();
  constexpr auto kZero = Celsius::from_raw(0);
  fields.fixed("ramp step", p.ramp.step_per_tick, least_positive<safety::Gain>(), safety::kFullForce);
  fields.fixed("contact force", p.ramp.contact_newtons, kNewton);
  fields.number("free ticks", p.ramp.free_ticks);
  fields.fixed("max force", p.force.max_newtons, kNewton);
  fields.fixed("force impulse of a tick", p.force.impulse_newtons_per_tick, kNewton);
  fields.fixed("force impulse of a window", p.force.impulse_newtons_per_window, kNewton);
  fields.fixed("max velocity", p.motion.max_metres_per_tick, least_positive<Metre>());
  fields.number("max counts of a tick", p.motion.max_counts_per_tick, 1);
  fields.fixed("moving current", p.motion.moving_amperes, Ampere::from_raw(0));
  fields.number("stuck ticks", p.motion.stuck_ticks, 1);
  fields.number("silent ticks", p.timing.silent_ticks, 1);
  fields.number("overrun ticks", p.timing.overrun_ticks, 1);
  fields.fixed("ambient", p.thermal.ambient, kZero);
  fields.fixed("warm", p.thermal.warm, kZero);
  fields.fixed("release", p.thermal.release, kZero);
  fields.fixed("winding limit", p.thermal.winding_limit, kZero);
  fields.fixed("peak current", p.thermal.peak_amperes, kAmpere);
  fields.fixed("continuous current", p.thermal.continuous_amperes, kAmpere);
  fields.fixed("decay of the current limit", p.thermal.decay_per_tick, least_positive<Q<0, 31>>());
  fields.fixed("rise of the current limit", p.thermal.rise_amperes_per_tick, kAmpere);
}
inline constexpr uint16_t kThresholds = 20;
inline constexpr uint32_t kThresholdBytes = 72;

/// 4 bytes.
template <class Fields, class AParameters>
void ignored(Fields& fields, AParameters& p) {
  fields.bits("ignored conditions", p.ignored, safety::ConditionSet::all().bits());
}

}  // namespace palpate::firmware::safety_fields
