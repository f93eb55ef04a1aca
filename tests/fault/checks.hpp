// What must hold in every tick, whatever is done to the device.
#pragma once

#include <string>

#include "causes.hpp"

namespace palpate::fault {

/// Pools in use, tethers and all.
struct PoolsInUse {
  uint32_t leaves, pairs, nodes, groups, tethers;
};
PoolsInUse pools_in_use(const Cycle& cycle);

class Checks {
 public:
  /// After each tick of the loop: the first rule that does not hold, or an empty string.
  std::string see(const Loop& loop);
  /// An event breaks the mesh: that it is not whole is no surprise from now on.
  void allow_broken_mesh() { may_be_broken_ = true; }
  void note_new_start();
  void allow_clamps() { may_clamp_ = true; }
  /// To look at all of a mesh takes as long as half a tick of the cycle. What is not whole stays so for more
  /// than a few ticks.
  void look_at_mesh_every(uint32_t ticks) { look_every_ = ticks; }

  [[nodiscard]] const Causes& causes() const { return causes_; }
  /// Ticks with its cause until a condition was raised, the worst so far; 0: never raised.
  [[nodiscard]] uint32_t detected_in(safety::Condition condition) const {
    return detected_in_[static_cast<std::size_t>(condition)];
  }
  /// Ticks with a cause until the torque was zero, over all conditions that take it away.
  [[nodiscard]] uint32_t zero_torque_in() const { return zero_torque_in_; }

 private:
  std::string check_conditions(const Loop& loop);
  std::string check_torque(const Loop& loop);
  void note_free_tick(const Cycle& cycle);
  std::string check_codes(const Loop& loop) const;
  std::string check_heat_limits(const Cycle& cycle);
  std::string check_body(const Loop& loop);
  std::string check_watchdog(const Loop& loop) const;
  [[nodiscard]] bool looks_at_mesh(const Loop& loop) const {
    return may_be_broken_ || loop.tick() % look_every_ == 0;
  }
  void note_detection(safety::ConditionSet raised);

  Causes causes_;
  safety::ConditionSet raised_;  // in the last tick
  int64_t line_ = 0;             // the highest gain of this tick, raw
  std::array<safety::Ampere, 3> limits_ = {device_parameters().thermal.peak_amperes,
                                           device_parameters().thermal.peak_amperes,
                                           device_parameters().thermal.peak_amperes};
  uint32_t free_ticks_ = 0;  // in a row, before the gain rises
  ClampCounters clamps_{};
  bool may_clamp_ = false;
  bool may_be_broken_ = false;
  uint32_t look_every_ = 1;
  std::array<uint32_t, safety::kConditionCount> detected_in_{};
  uint32_t zero_torque_in_ = 0;
};

}  // namespace palpate::fault
