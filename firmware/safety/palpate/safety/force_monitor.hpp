// Watches the force that the body asks for, before gain and current limits: its size (max force) and how fast
// it changes (force impulse).
#pragma once

#include "palpate/phantom/units.hpp"
#include "palpate/safety/condition_set.hpp"
#include "palpate/safety/magnitude.hpp"
#include "palpate/safety/parameters.hpp"

namespace palpate::safety {

using Force3 = Vector3<phantom::Newton>;

/// The forces of the last kImpulseWindowTicks ticks, the oldest at `oldest`.
struct ForceMonitor {
  std::array<Force3, kImpulseWindowTicks> last;
  uint32_t oldest;
  bool is_primed;
};

inline ForceMonitor make_force_monitor() {
  const Force3 zero = zero_vector<phantom::Newton>();
  return {{zero, zero, zero, zero, zero, zero, zero, zero}, 0, false};
}

/// |F| above max; |F - F of the last tick| or |F - F of kImpulseWindowTicks ago| above the impulse limits.
/// The first force is no change. Equal to a limit is within it. 14 multiplies.
inline ConditionSet watch_force(ForceMonitor& monitor, const ForceLimits& limits, const Force3& force) {
  static_assert((kImpulseWindowTicks & (kImpulseWindowTicks - 1)) == 0,
                "palpate: the window is a power of 2");
  constexpr uint32_t kMask = kImpulseWindowTicks - 1;
  if (!monitor.is_primed) {
    for (const uint32_t i : bounded<kImpulseWindowTicks>(kImpulseWindowTicks, [] {})) monitor.last[i] = force;
    monitor.is_primed = true;
  }
  const Force3 in_tick = saturated_difference(force, monitor.last[(monitor.oldest - 1) & kMask]);
  const Force3 in_window = saturated_difference(force, monitor.last[monitor.oldest & kMask]);
  monitor.last[monitor.oldest & kMask] = force;
  monitor.oldest = (monitor.oldest + 1) & kMask;
  const bool is_impulse = square_norm(in_tick) > square(limits.impulse_newtons_per_tick) ||
                          square_norm(in_window) > square(limits.impulse_newtons_per_window);
  return ConditionSet::of(Condition::kMaxForce, square_norm(force) > square(limits.max_newtons)) |
         ConditionSet::of(Condition::kForceImpulse, is_impulse);
}

}  // namespace palpate::safety
