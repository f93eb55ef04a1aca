// Watches the encoders: counts outside their range, jumps that no hand makes, and counts that stand still
// while a motor pulls.
#pragma once

#include "palpate/phantom/joint_angles.hpp"
#include "palpate/safety/condition_set.hpp"
#include "palpate/safety/parameters.hpp"

namespace palpate::safety {

struct EncoderMonitor {
  phantom::Counts last;
  std::array<uint16_t, 3> stuck_ticks;
  uint16_t silent_ticks;  // since the last message
  bool is_primed;
};

constexpr EncoderMonitor make_encoder_monitor() { return {{}, {}, 0, false}; }

namespace encoder {

/// |a - b| of any two counts.
constexpr int64_t distance(int32_t a, int32_t b) {
  const int64_t difference = int64_t{a} - b;
  return difference < 0 ? -difference : difference;
}

/// After messages that did not come, each missing tick has its share of the way.
inline bool jumps(const EncoderMonitor& monitor, const MotionLimits& limits, const phantom::Counts& counts) {
  const int64_t allowed = int64_t{limits.max_counts_per_tick} * (int64_t{monitor.silent_ticks} + 1);
  return distance(counts[0], monitor.last[0]) > allowed || distance(counts[1], monitor.last[1]) > allowed ||
         distance(counts[2], monitor.last[2]) > allowed;
}

}  // namespace encoder

/// `is_new`: the counts come from a new message; of others only the range is judged. `currents`: those of the
/// last tick, which the counts answer. The first counts are no jump. A joint is stuck in the stuck_ticks-th
/// tick in a row in which it did not move though its current was above moving_amperes; a new message that
/// shows motion, or less current, ends it. Without a message a joint counts as standing. 3 multiplies.
inline ConditionSet watch_encoders(EncoderMonitor& monitor, const MotionLimits& limits,
                                   const phantom::Counts& counts, bool is_new,
                                   const std::array<Ampere, 3>& currents) {
  const bool is_jump = is_new && monitor.is_primed && encoder::jumps(monitor, limits, counts);
  bool is_stuck = false;
  for (const uint32_t joint : bounded<3>(3, [] {})) {
    const bool stands = monitor.is_primed && (!is_new || counts[joint] == monitor.last[joint]);
    const Ampere current = clamp(currents[joint], -Ampere::max(), Ampere::max());
    uint16_t& ticks = monitor.stuck_ticks[joint];
    if (!stands || abs(current) <= limits.moving_amperes) {
      ticks = 0;
    } else if (ticks < limits.stuck_ticks) {
      ++ticks;
    }
    is_stuck = is_stuck || ticks >= limits.stuck_ticks;
  }
  constexpr uint16_t kMost = std::numeric_limits<uint16_t>::max();
  if (is_new) {
    monitor.last = counts;
    monitor.is_primed = true;
    monitor.silent_ticks = 0;
  } else if (monitor.silent_ticks < kMost) {
    ++monitor.silent_ticks;
  }
  return ConditionSet::of(Condition::kEncoderRange, !phantom::counts_in_range(counts)) |
         ConditionSet::of(Condition::kEncoderJump, is_jump) |
         ConditionSet::of(Condition::kEncoderStuck, is_stuck);
}

}  // namespace palpate::safety
