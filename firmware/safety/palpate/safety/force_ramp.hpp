// The gain of the force: 0 whenever no torque is allowed, then up to 1 along a line. It never rises by more
// than step_per_tick, and falls to 0 at once.
//
// It begins to rise only after the hand has been free, the asked force below contact_newtons for free_ticks
// in a row: who is enabled inside the body feels nothing until he leaves it.
#pragma once

#include "palpate/phantom/units.hpp"
#include "palpate/safety/magnitude.hpp"
#include "palpate/safety/parameters.hpp"

namespace palpate::safety {

struct ForceRamp {
  Gain gain;
  uint16_t free_ticks;  // in a row
};

constexpr ForceRamp make_force_ramp() { return {kNoForce, 0}; }

/// The gain of this tick. `is_allowed`: torque is, and nothing that drops it lasts. The first tick above 0 is
/// the free_ticks-th free one. 4 multiplies.
inline Gain advance(ForceRamp& ramp, const RampParameters& parameters, bool is_allowed,
                    const Vector3<phantom::Newton>& force) {
  if (!is_allowed) {
    ramp = make_force_ramp();
    return ramp.gain;
  }
  const bool is_free = square_norm(force) < square(parameters.contact_newtons);
  if (ramp.free_ticks < parameters.free_ticks) {
    ramp.free_ticks = is_free ? static_cast<uint16_t>(ramp.free_ticks + 1) : uint16_t{0};
  }
  if (ramp.free_ticks >= parameters.free_ticks) {
    const Gain room = kFullForce - ramp.gain;
    ramp.gain += room < parameters.step_per_tick ? room : parameters.step_per_tick;
  }
  return ramp.gain;
}

/// gain F, rounded to nearest: exactly F at 1, exactly 0 at 0. 3 multiplies.
inline Vector3<phantom::Newton> scaled(Gain gain, const Vector3<phantom::Newton>& force) {
  return Vector3<phantom::Newton>(narrow<phantom::Newton>(gain * force.x()),
                                  narrow<phantom::Newton>(gain * force.y()),
                                  narrow<phantom::Newton>(gain * force.z()));
}

}  // namespace palpate::safety
