// Which conditions hold, computed once more from what goes into the cycle and what the body asks for, in
// doubles and whole counts: the safety layer must find the same within its detection time, and nothing else.
#pragma once

#include <deque>

#include "loop.hpp"

namespace palpate::fault {

/// Leaves are examined four a tick: a wrong one is found when its turn comes, or in the next round if a
/// change of the mesh has taken it to where the walk had been.
inline constexpr uint32_t kInvariantTicks = 2 * Small::kLeaves + 1;

class Causes {
 public:
  /// After each tick of the loop. Without a look at the mesh it counts as whole.
  void see(const Loop& loop, bool looks_at_mesh);
  void note_new_start() { *this = Causes(); }

  /// For so many ticks in a row, this one included; 0: it is not there.
  [[nodiscard]] uint32_t ticks_of(safety::Condition condition) const {
    return ticks_[static_cast<std::size_t>(condition)];
  }
  /// Ticks until it must be raised.
  [[nodiscard]] uint32_t detection_ticks(safety::Condition condition) const;
  /// What must be raised by now.
  [[nodiscard]] safety::ConditionSet due() const;
  /// What may be raised: a cause, or what is so near to a limit that doubles do not tell.
  [[nodiscard]] safety::ConditionSet possible() const { return holds_ | unsure_; }

 private:
  using Condition = safety::Condition;
  void note(Condition condition, bool holds);
  /// Above a limit; near to it nobody knows.
  void note_above(Condition condition, double value, double limit, double error);
  void watch_clockwork(const firmware::Sensors& sensors);
  void watch_counts(const firmware::Sensors& sensors);
  void watch_force(const Cycle& cycle);
  void watch_speed(const Cycle& cycle, const firmware::Sensors& sensors);
  void watch_heat(const Cycle& cycle);
  void watch_mesh(const Cycle& cycle);

  safety::ConditionSet holds_, unsure_;
  std::array<uint32_t, safety::kConditionCount> ticks_{};
  uint32_t stuck_ticks_ = kStuckTicks;
  // Of the tick before.
  bool has_last_ = false;
  firmware::Sensors last_{};
  std::array<uint16_t, 3> last_codes_ = firmware::at_rest().motor_codes;
  phantom::Counts last_new_counts_{};
  phantom::Counts counts_at_reset_{};
  bool is_new_ = false;
  uint32_t silent_ticks_ = 0;
  std::array<uint32_t, 3> still_ticks_{};
  std::deque<Eigen::Vector3d> forces_;  // of the last window
  Eigen::Vector3d last_position_ = Eigen::Vector3d::Zero();
  bool has_position_ = false;
};

}  // namespace palpate::fault
