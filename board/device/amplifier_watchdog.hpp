// The circuit that cuts the amplifiers when its line stops toggling, seen from the program.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::device {

/// Which level the line has, and whether the circuit can be content yet.
class AmplifierWatchdog {
 public:
  /// The line's next level.
  constexpr bool toggle() {
    level_ = !level_;
    if (feedings_ < kSettled) ++feedings_;
    return level_;
  }

  /// Before it was fed the circuit has cut the amplifiers, as it should, and that is no fault.
  [[nodiscard]] constexpr bool must_be_content() const { return feedings_ == kSettled; }

 private:
  static constexpr uint32_t kSettled = 4;  // feedings: it may trigger on either edge alone
  bool level_ = false;
  uint32_t feedings_ = 0;
};

}  // namespace palpate::device
