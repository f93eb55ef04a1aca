#include "palpate/phantom/omni.hpp"

#include <gtest/gtest.h>

#include "phantom_reference.hpp"

namespace palpate::phantom::omni {
namespace {

using test::Triple;
using test::WorstError;

constexpr double kL1 = 0.13335, kL2 = 0.13335, kL3 = 0.02335, kL4 = 0.16835;
// Waist and shoulder; q3 = shoulder + elbow + 1.5 lies within these.
const std::array<std::array<double, 2>, 3> kLimits{{{-0.98, 0.98}, {0, 1.75}, {-2.31, 3.0}}};

bool anywhere(const Triple&) { return true; }

Triple position(const Triple& q) {
  const double reach = kL1 * std::cos(q[1]) + kL2 * std::sin(q[2]);
  return {-reach * std::sin(q[0]), kL1 * std::sin(q[1]) - kL2 * std::cos(q[2]) + kL3,
          reach * std::cos(q[0]) - kL4};
}

test::Square jacobian(const Triple& q) {
  const double s1 = std::sin(q[0]), s2 = std::sin(q[1]), s3 = std::sin(q[2]);
  const double c1 = std::cos(q[0]), c2 = std::cos(q[1]), c3 = std::cos(q[2]);
  const double reach = kL1 * c2 + kL2 * s3;
  return {{{-reach * c1, kL1 * s2 * s1, -kL2 * c3 * s1},
           {0, kL1 * c2, kL2 * s3},
           {-reach * s1, -kL1 * s2 * c1, kL2 * c3 * c1}}};
}

/// For a reach above 0 and an elbow that bends as the zero pose does.
Triple inverse(const Triple& p) {
  const double forward = p[2] + kL4, up = p[1] - kL3;
  const double reach = std::hypot(forward, p[0]);
  const double d = std::hypot(reach, up);
  const double q2 = std::acos((kL1 * kL1 + d * d - kL2 * kL2) / (2 * kL1 * d)) + std::atan2(up, reach);
  const double q3 = std::acos((kL1 * kL1 + kL2 * kL2 - d * d) / (2 * kL1 * kL2)) + q2 - test::kPi / 2;
  return {std::atan2(-p[0], forward), q2, q3};
}

TEST(OmniCounts, SayThatTheyAreUnverified) {
  EXPECT_FALSE(omni::kCountsPerRadianVerified);
  EXPECT_FALSE(omni::kLengthsVerified);
  EXPECT_FALSE(omni::kInkwellVerified);
}

TEST(OmniCounts, ResolveThePublished55Micrometres) {
  const double raw_per_count = test::to_double(omni::kPlaceholder.angle_per_count[0]);
  const double counts_per_radian = 4294967296.0 / (2 * test::kPi) / raw_per_count;
  EXPECT_GE(counts_per_radian, 3060);
  EXPECT_LE(counts_per_radian, 3061);
  const JointAngles q = joint_angles(omni::kPlaceholder, {3060, -3060, 0});
  EXPECT_NEAR(test::to_radians(q.q1), 1, 1e-4);
  EXPECT_NEAR(test::to_radians(q.q2), -1, 1e-4);
  EXPECT_EQ(q.q3.raw(), 0);
}

TEST(OmniPosition, IsThePublishedUncalibratedPoseAtZero) {
  const Triple pose =
      test::to_triple(omni::tool_position(omni::posture(joint_angles(omni::kPlaceholder, {}))));
  EXPECT_NEAR(pose[0], 0, 1e-9);
  EXPECT_NEAR(pose[1], -0.110, 2e-9);
  EXPECT_NEAR(pose[2], -0.035, 2e-9);
}

/// Whatever the decoders show in the inkwell: there and anywhere else the tool is where it is.
TEST(OmniPosition, IsCalibratedInTheInkwell) {
  const Triple in_inkwell = inverse({0, -0.0655, -0.0881});
  const Counts shown = {1234, -4321, 77};
  const auto position_at = [&shown](const Counts& counts) {
    const JointAngles angles = joint_angles(omni::kInkwell, counts_since(shown, counts));
    return test::to_triple(omni::tool_position(omni::posture(angles)));
  };
  const Triple there = position_at(shown);
  EXPECT_NEAR(there[0], 0, 1e-9);
  EXPECT_NEAR(there[1], -0.0655, 2e-5);
  EXPECT_NEAR(there[2], -0.0881, 2e-5);
  const double radians_per_count = 2 * test::kPi / 19227;
  const Triple moved =
      position({in_inkwell[0] + 900 * radians_per_count, in_inkwell[1] + 2000 * radians_per_count,
                in_inkwell[2] - 300 * radians_per_count});
  const Triple seen = position_at({1234 + 900, -4321 + 2000, 77 - 300});
  for (const double error : test::difference(seen, moved)) EXPECT_NEAR(error, 0, 3e-5);
}

TEST(OmniPosition, HasItsOriginInTheMiddleOfTheWorkspace) {
  const JointAngles centre{Angle::from_raw(0), Angle::of_turn(425, 3600), Angle::of_turn(317, 3600)};
  const Triple pose = test::to_triple(omni::tool_position(omni::posture(centre)));
  for (const double coordinate : pose) EXPECT_NEAR(coordinate, 0, 1e-4);
}

TEST(OmniPosition, StaysWithinItsErrorBoundOverTheJointRange) {
  WorstError worst;
  test::for_each_posture(kLimits, test::soaking() ? 200 : 60, anywhere, [&](const Triple& q) {
    const JointAngles angles = test::to_angles(q);
    const Triple exact = position(test::to_radians(angles));
    const Triple fixed = test::to_triple(omni::tool_position(omni::posture(angles)));
    for (const double error : test::difference(fixed, exact)) worst.see(error * 1e9, angles.q2.raw());
  });
  RecordProperty("worst_nm", std::to_string(worst.error));
  EXPECT_LE(worst.error, 1.6);
}

TEST(OmniPosition, ReturnsThroughTheInverseKinematics) {
  int visited = 0;
  const auto bent = [](const Triple& q) {
    const double fold = q[2] - q[1];
    return std::fabs(fold) < 1.4 && kL1 * std::cos(q[1]) + kL2 * std::sin(q[2]) > 0.02;
  };
  test::for_each_posture(kLimits, 40, bent, [&](const Triple& q) {
    ++visited;
    const Triple fixed = test::to_triple(omni::tool_position(omni::posture(test::to_angles(q))));
    for (const double error : test::difference(inverse(fixed), q)) ASSERT_NEAR(error, 0, 2e-7);
  });
  EXPECT_GT(visited, 10000);
}

TEST(OmniTorques, JacobianIsTheDerivativeOfThePosition) {
  test::for_each_posture(kLimits, 10, anywhere, [](const Triple& q) {
    EXPECT_LE(test::difference_from_finite_differences(jacobian(q), q, position), 1e-9);
  });
}

TEST(OmniTorques, StayWithinTheirErrorBoundOverTheJointRange) {
  const Triple forces[] = {
      {15.99, 15.99, 15.99}, {-16, 15.99, -16}, {-16, -16, -16}, {0.5, -0.3, 0.7}, {0, 0, -3.3}};
  WorstError worst;
  test::for_each_posture(kLimits, test::soaking() ? 120 : 40, anywhere, [&](const Triple& q) {
    const JointAngles angles = test::to_angles(q);
    const Posture posture = omni::posture(angles);
    const test::Square exact_jacobian = jacobian(test::to_radians(angles));
    for (const Triple& newtons : forces) {
      const auto force = test::to_force(newtons);
      const Triple exact = test::transposed_times(exact_jacobian, test::to_triple(force));
      const Triple fixed = test::to_triple(omni::joint_torques(posture, force));
      for (const double error : test::difference(fixed, exact)) worst.see(error * 1e9, angles.q2.raw());
    }
  });
  RecordProperty("worst_nano_newton_metre", std::to_string(worst.error));
  EXPECT_LE(worst.error, 40);
}

TEST(OmniTorques, AgreeWithTheirAxesAtTheZeroPose) {
  const Posture posture = omni::posture(joint_angles(omni::kPlaceholder, {}));
  const Triple pushed_right = test::to_triple(omni::joint_torques(posture, test::to_force({1, 0, 0})));
  const Triple pushed_up = test::to_triple(omni::joint_torques(posture, test::to_force({0, 1, 0})));
  const Triple pulled = test::to_triple(omni::joint_torques(posture, test::to_force({0, 0, 1})));
  EXPECT_NEAR(pushed_right[0], -kL1, 1e-8);
  EXPECT_NEAR(pushed_up[1], kL1, 1e-8);
  EXPECT_NEAR(pulled[2], kL2, 1e-8);
}

}  // namespace
}  // namespace palpate::phantom::omni
