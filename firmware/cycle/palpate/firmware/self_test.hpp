// What the processor computes must be what the program was tested with. Known answers, through the code that
// the cycle uses, each within the error that its header states.
#pragma once

#include "palpate/phantom/premium.hpp"

namespace palpate::firmware {

/// Straight through counts, posture, position, torques and codes at one pose: that of the encoders' reset,
/// where P = (0.215, 0, -0.170) m, and 1 N upwards asks for 0.215 N m of joint 2: - 0.8204 A, code 1743.
[[nodiscard]] inline bool passes_self_test() {
  namespace premium = phantom::premium;
  constexpr auto kWithin = phantom::Metre::ratio(1, 100000000);
  const auto posture = premium::posture(phantom::joint_angles(premium::kPremium15, {0, 0, 0}));
  const auto position = premium::tool_position(posture);
  const bool is_at_reset = abs(position[0] - phantom::Metre::ratio(215, 1000)) < kWithin &&
                           abs(position[1]) < kWithin &&
                           abs(position[2] + phantom::Metre::ratio(170, 1000)) < kWithin;
  const auto codes_for = [&posture](phantom::Newton up) {
    Vector3<phantom::Newton> force = zero_vector<phantom::Newton>();
    force[2] = up;
    return phantom::motor_codes(premium::kDrive, premium::joint_torques(posture, force)).codes;
  };
  const auto at_rest = codes_for(phantom::Newton::from_raw(0));
  const auto lifting = codes_for(phantom::Newton::ratio(1, 1));
  return is_at_reset && at_rest == std::array<uint16_t, 3>{2048, 2048, 2048} &&
         lifting == std::array<uint16_t, 3>{2048, 1743, 2048};
}

}  // namespace palpate::firmware
