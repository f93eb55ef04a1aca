#include "palpate/phantom/premium.hpp"

#include <gtest/gtest.h>

#include "phantom_reference.hpp"

namespace palpate::phantom::premium {
namespace {

using test::degrees;
using test::Triple;
using test::WorstError;

constexpr double kL1 = 0.215;
constexpr double kL2 = 0.170;
const std::array<std::array<double, 2>, 3> kLimits{
    {{degrees(-90), degrees(90)}, {degrees(-124), degrees(119)}, {degrees(-29), degrees(214)}}};

bool reachable(const Triple& q) { return q[1] - q[2] <= degrees(65) && q[2] - q[1] <= degrees(55); }

Triple position(const Triple& q) {
  const double rho = kL1 * std::cos(q[1]) + kL2 * std::sin(q[2]);
  return {std::cos(q[0]) * rho, std::sin(q[0]) * rho, kL1 * std::sin(q[1]) - kL2 * std::cos(q[2])};
}

test::Square jacobian(const Triple& q) {
  const double s1 = std::sin(q[0]), s2 = std::sin(q[1]), s3 = std::sin(q[2]);
  const double c1 = std::cos(q[0]), c2 = std::cos(q[1]), c3 = std::cos(q[2]);
  const double rho = kL1 * c2 + kL2 * s3;
  return {{{-s1 * rho, -kL1 * c1 * s2, kL2 * c1 * c3},
           {c1 * rho, -kL1 * s1 * s2, kL2 * s1 * c3},
           {0, kL1 * c2, kL2 * s3}}};
}

/// For rho > 0 and q3 - q2 > -90 degrees, which the limits keep.
Triple inverse(const Triple& p) {
  const double d = test::norm(p);
  const double q2 =
      std::acos((kL1 * kL1 + d * d - kL2 * kL2) / (2 * kL1 * d)) + std::atan2(p[2], std::hypot(p[0], p[1]));
  const double q3 = std::acos((kL1 * kL1 + kL2 * kL2 - d * d) / (2 * kL1 * kL2)) + q2 - test::kPi / 2;
  return {std::atan2(p[1], p[0]), q2, q3};
}

Counts natural_counts(const Triple& q) {
  const auto count = [&q](std::size_t joint, double ratio) {
    return static_cast<int32_t>(std::lround(-q[joint] * 4096 * ratio / (2 * test::kPi)));
  };
  return {count(0, 13.3), count(1, 11.2), count(2, 11.2)};
}

TEST(PremiumCounts, HaveThePublishedResolution) {
  const double counts_per_radian[] = {8670, 7301, 7301};
  for (std::size_t joint = 0; joint < 3; ++joint) {
    const double raw_per_count = test::to_double(premium::kPremium15.angle_per_count[joint]);
    EXPECT_NEAR(-4294967296.0 / (2 * test::kPi) / raw_per_count, counts_per_radian[joint], 0.5);
  }
}

TEST(PremiumCounts, BecomeAnglesWithinTheBound) {
  const double ratios[] = {13.3, 11.2, 11.2};
  WorstError worst;
  for (int32_t count = -32768; count <= 32767; ++count) {
    const JointAngles q = joint_angles(premium::kPremium15, {count, count, count});
    const Angle angles[] = {q.q1, q.q2, q.q3};
    for (std::size_t joint = 0; joint < 3; ++joint) {
      const double turns = -count / (4096 * ratios[joint]);
      const double error = std::remainder(std::ldexp(angles[joint].raw(), -32) - turns, 1.0);
      worst.see(std::ldexp(error, 32), count);
    }
  }
  RecordProperty("worst_lsb", std::to_string(worst.error));
  EXPECT_LE(worst.error, 2.5) << "at " << worst.at;
}

TEST(PremiumCounts, HoldEveryJointRange) {
  const auto check = [](const Triple& q) { EXPECT_TRUE(counts_in_range(natural_counts(q))); };
  test::for_each_posture(
      kLimits, 1, [](const Triple&) { return true; }, check);
}

TEST(PremiumCounts, AreClampedTo16Bits) {
  const auto& calibration = premium::kPremium15;
  const JointAngles top = joint_angles(calibration, {32767, 32767, 32767});
  const JointAngles above = joint_angles(calibration, {32768, 1 << 30, std::numeric_limits<int32_t>::max()});
  EXPECT_EQ(top.q1, above.q1);
  EXPECT_EQ(top.q2, above.q2);
  EXPECT_EQ(top.q3, above.q3);
  const JointAngles bottom = joint_angles(calibration, {-32768, 0, 0});
  EXPECT_EQ(joint_angles(calibration, {std::numeric_limits<int32_t>::min(), 0, 0}).q1, bottom.q1);
  EXPECT_TRUE(counts_in_range({-32768, 32767, 0}));
  EXPECT_FALSE(counts_in_range({0, 32768, 0}));
  EXPECT_FALSE(counts_in_range({0, 0, -32769}));
}

TEST(PremiumCounts, StartFromTheCalibratedPose) {
  const Calibration calibration = make_calibration(
      premium::kEncoders, {Angle::of_turn(1, 8), Angle::of_turn(-1, 8), Angle::of_turn(30, 360)});
  const JointAngles q = joint_angles(calibration, {0, 0, 0});
  EXPECT_EQ(q.q1, Angle::of_turn(1, 8));
  EXPECT_EQ(q.q2, Angle::of_turn(-1, 8));
  EXPECT_EQ(q.q3, Angle::of_turn(30, 360));
}

TEST(PremiumPosition, IsOrthogonalAtZero) {
  const auto pose = premium::tool_position(premium::posture(joint_angles(premium::kPremium15, {0, 0, 0})));
  EXPECT_NEAR(pose.x().raw(), Metre::ratio(215, 1000).raw(), 1);
  EXPECT_EQ(pose.y().raw(), 0);
  EXPECT_NEAR(pose.z().raw(), -Metre::ratio(170, 1000).raw(), 1);
}

TEST(PremiumPosition, StaysWithinItsErrorBoundOverTheJointRange) {
  WorstError worst;
  test::for_each_posture(
      kLimits, test::soaking() ? 200 : 60, [](const Triple&) { return true; },
      [&](const Triple& q) {
        const JointAngles angles = test::to_angles(q);
        const Triple exact = position(test::to_radians(angles));
        const Triple fixed = test::to_triple(premium::tool_position(premium::posture(angles)));
        for (const double error : test::difference(fixed, exact)) worst.see(error * 1e9, angles.q2.raw());
      });
  RecordProperty("worst_nm", std::to_string(worst.error));
  EXPECT_LE(worst.error, 1.3);
}

TEST(PremiumPosition, ReturnsThroughTheInverseKinematics) {
  int visited = 0;
  test::for_each_posture(kLimits, 40, reachable, [&](const Triple& q) {
    if (kL1 * std::cos(q[1]) + kL2 * std::sin(q[2]) < 0.02) return;
    ++visited;
    const Triple fixed = test::to_triple(premium::tool_position(premium::posture(test::to_angles(q))));
    for (const double error : test::difference(inverse(fixed), q)) ASSERT_NEAR(error, 0, 2e-7);
  });
  EXPECT_GT(visited, 10000);
}

TEST(PremiumPosition, ResolvesTheTipAsPublished) {
  // One count of each joint at the zero pose moves the tip by 0.025, 0.029 and 0.023 mm.
  const Triple at_zero =
      test::to_triple(premium::tool_position(premium::posture(joint_angles(premium::kPremium15, {}))));
  const double expected_mm[] = {0.0248, 0.0294, 0.0233};
  for (std::size_t joint = 0; joint < 3; ++joint) {
    Counts one{};
    one[joint] = 1;
    const JointAngles angles = joint_angles(premium::kPremium15, one);
    const Triple moved = test::to_triple(premium::tool_position(premium::posture(angles)));
    const double step_mm = 1000 * test::norm(test::difference(moved, at_zero));
    EXPECT_NEAR(step_mm, expected_mm[joint], 0.0001);
    EXPECT_GE(step_mm, 0.023);
    EXPECT_LE(step_mm, 0.0295);
  }
}

TEST(PremiumTorques, JacobianIsTheDerivativeOfThePosition) {
  test::for_each_posture(kLimits, 10, reachable, [](const Triple& q) {
    EXPECT_LE(test::difference_from_finite_differences(jacobian(q), q, position), 1e-9);
  });
}

TEST(PremiumTorques, StayWithinTheirErrorBoundOverTheJointRange) {
  const Triple forces[] = {{16, 16, 16},     {-16, 16, -16}, {-16, -16, -16},
                           {1.5, -0.3, 0.7}, {0, 0, -8.5},   {3, 0, 0}};
  WorstError worst;
  test::for_each_posture(
      kLimits, test::soaking() ? 120 : 40, [](const Triple&) { return true; },
      [&](const Triple& q) {
        const JointAngles angles = test::to_angles(q);
        const Posture posture = premium::posture(angles);
        const test::Square exact_jacobian = jacobian(test::to_radians(angles));
        for (const Triple& newtons : forces) {
          Triple held = newtons;
          for (double& f : held) f = std::fmin(f, test::to_double(Newton::max()));
          const auto force = test::to_force(held);
          const Triple exact = test::transposed_times(exact_jacobian, test::to_triple(force));
          const Triple fixed = test::to_triple(premium::joint_torques(posture, force));
          for (const double error : test::difference(fixed, exact)) worst.see(error * 1e9, angles.q2.raw());
        }
      });
  RecordProperty("worst_nano_newton_metre", std::to_string(worst.error));
  EXPECT_LE(worst.error, 40);
}

TEST(PremiumTorques, BalanceThePowerAtTheTip) {
  // F . (P(q + dq) - P(q - dq)) = tau . 2 dq, all of it from the fixed-point functions.
  const Triple rates{0.7, -1.1, 0.9};
  constexpr double kStep = 1e-4;
  const auto force = test::to_force({1.2, -2.3, 3.1});
  test::for_each_posture(kLimits, 12, reachable, [&](const Triple& q) {
    Triple ahead = q;
    Triple behind = q;
    for (std::size_t joint = 0; joint < 3; ++joint) {
      ahead[joint] += kStep * rates[joint];
      behind[joint] -= kStep * rates[joint];
    }
    const auto at = [](const Triple& angles) {
      return test::to_triple(premium::tool_position(premium::posture(test::to_angles(angles))));
    };
    const double tip_power =
        test::dot(test::to_triple(force), test::difference(at(ahead), at(behind))) / (2 * kStep);
    const auto torques = premium::joint_torques(premium::posture(test::to_angles(q)), force);
    ASSERT_NEAR(tip_power, test::dot(test::to_triple(torques), rates), 1e-4);
  });
}

TEST(PremiumTorques, AreZeroForNoForce) {
  const Posture posture =
      premium::posture({Angle::of_turn(1, 7), Angle::of_turn(-1, 9), Angle::of_turn(1, 5)});
  const auto torques = premium::joint_torques(posture, zero_vector<Newton>());
  EXPECT_EQ(torques.x().raw(), 0);
  EXPECT_EQ(torques.y().raw(), 0);
  EXPECT_EQ(torques.z().raw(), 0);
}

}  // namespace
}  // namespace palpate::phantom::premium
