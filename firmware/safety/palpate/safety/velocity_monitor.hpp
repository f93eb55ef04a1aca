// Watches how far the tool moves in a tick (max velocity).
#pragma once

#include "palpate/phantom/units.hpp"
#include "palpate/safety/condition_set.hpp"
#include "palpate/safety/magnitude.hpp"
#include "palpate/safety/parameters.hpp"

namespace palpate::safety {

using Position3 = Vector3<phantom::Metre>;

struct VelocityMonitor {
  Position3 last;
  bool is_primed;
};

inline VelocityMonitor make_velocity_monitor() { return {zero_vector<phantom::Metre>(), false}; }

/// |p - p of the last tick| above max_metres_per_tick; the first position is no motion, equal to the limit is
/// within it. An encoder's step of 0.03 mm a tick reads as 0.03 m/s, far below any limit. 4 multiplies.
inline ConditionSet watch_velocity(VelocityMonitor& monitor, const MotionLimits& limits,
                                   const Position3& position) {
  const Position3 moved = saturated_difference(position, monitor.is_primed ? monitor.last : position);
  monitor = {position, true};
  return ConditionSet::of(Condition::kMaxVelocity, square_norm(moved) > square(limits.max_metres_per_tick));
}

}  // namespace palpate::safety
