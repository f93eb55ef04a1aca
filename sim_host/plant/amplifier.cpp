#include "plant/amplifier.hpp"

#include <algorithm>

#include "palpate/phantom/motor_code.hpp"

namespace palpate::plant {

void Amplifiers::receive(const AmplifierInput& input) {
  if (input.watchdog_line != input_.watchdog_line) {
    ticks_without_edge_ = 0;
  } else if (!is_dropped_out()) {
    ++ticks_without_edge_;
  }
  input_ = input;
}

double Amplifiers::target_current(std::size_t axis) const {
  const int32_t code = input_.codes[axis] & phantom::kHighestCode;
  const double current = (code - phantom::kZeroCode) * parameters_.full_scale / phantom::kFullScaleCodes;
  return std::clamp(current, -parameters_.current_limit, parameters_.current_limit);
}

}  // namespace palpate::plant
