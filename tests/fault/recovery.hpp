// The way back: a hand goes home, the user acknowledges, tests, calibrates and enables; then the hand
// presses, feels force, and leaves a body that is as it was.
#pragma once

#include "checks.hpp"

namespace palpate::fault {

class Recovery {
 public:
  Recovery(Loop& loop, Checks& checks) : loop_(loop), checks_(checks) {}

  /// The first thing that does not come back, or an empty string. `needs_start`: only a new start helps.
  std::string run(bool needs_start);
  /// After run: that the body leaves nothing behind in the pools.
  std::string come_to_rest(const PoolsInUse& at_rest);
  [[nodiscard]] uint32_t ticks_to_active() const { return ticks_to_active_; }

 private:
  std::string advance();
  std::string stay_in_fault();
  std::string reach_active();
  std::string feel_force();

  Loop& loop_;
  Checks& checks_;
  uint32_t ticks_to_active_ = 0;
};

}  // namespace palpate::fault
