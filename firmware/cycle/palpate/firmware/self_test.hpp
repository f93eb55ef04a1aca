// What the processor computes must be what the program was tested with. Known answers, through the code that
// the cycle uses, each within the error that its header states.
#pragma once

#include "palpate/numeric/bounded.hpp"
#include "palpate/phantom/premium.hpp"

namespace palpate::firmware {

/// Straight through counts, posture, position, torques and codes at one pose: that of the encoders' reset,
/// where P = (0.215, 0, -0.170) m, and 1 N upwards asks for 0.215 N m of joint 2: - 0.8204 A, code 1743.
[[nodiscard]] inline bool passes_self_test() {
  namespace premium = phantom::premium;
  using phantom::Metre;
  using phantom::Newton;
  constexpr std::array<Metre, 3> kAtReset = {Metre::ratio(215, 1000), Metre::ratio(0, 1),
                                             Metre::ratio(-170, 1000)};
  constexpr auto kWithin = Metre::ratio(1, 100000000);
  struct Answer {
    Newton upwards;
    std::array<uint16_t, 3> codes;
  };
  constexpr std::array<Answer, 2> kAnswers = {
      {{Newton::ratio(0, 1), {2048, 2048, 2048}}, {Newton::ratio(1, 1), {2048, 1743, 2048}}}};

  const auto posture = premium::posture(phantom::joint_angles(premium::kPremium15, {0, 0, 0}));
  const auto position = premium::tool_position(posture);
  uint32_t wrong = 0;
  for (const uint32_t i : bounded<3>(3, [] {})) {
    wrong |= abs(position[static_cast<Eigen::Index>(i)] - kAtReset[i]) < kWithin ? 0u : 1u;
  }
  for (const uint32_t i : bounded<2>(2, [] {})) {
    Vector3<Newton> force = zero_vector<Newton>();
    force[2] = kAnswers[i].upwards;
    const auto codes = phantom::motor_codes(premium::kDrive, premium::joint_torques(posture, force)).codes;
    for (const uint32_t motor : bounded<3>(3, [] {}))
      wrong |= uint32_t{codes[motor]} ^ kAnswers[i].codes[motor];
  }
  return wrong == 0;
}

}  // namespace palpate::firmware
