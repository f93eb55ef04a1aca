#include "plant/encoders.hpp"

#include <gtest/gtest.h>

#include "arms.hpp"
#include "model/units.hpp"
#include "plant/omni.hpp"

namespace palpate::plant {
namespace {

Eigen::Vector3d seen_by_hal(const std::array<int16_t, 3>& counts) {
  const phantom::JointAngles q =
      phantom::joint_angles(phantom::premium::kPremium15, {counts[0], counts[1], counts[2]});
  const auto to_radians = [](Angle angle) { return std::ldexp(2.0 * kPi * angle.raw(), -32); };
  return {to_radians(q.q1), to_radians(q.q2), to_radians(q.q3)};
}

TEST(Encoders, AreZeroWithTheLinksOrthogonal) {
  EXPECT_EQ(encoder_counts(premium::kEncoders, Eigen::Vector3d::Zero()), Eigen::Vector3d::Zero());
}

TEST(Encoders, HaveThePublishedResolutionAndDirection) {
  const Eigen::Vector3d counts = encoder_counts(premium::kEncoders, Eigen::Vector3d::Ones());
  EXPECT_NEAR(counts[0], -8670.0, 0.5);
  EXPECT_NEAR(counts[1], -7301.0, 0.5);
  EXPECT_NEAR(counts[2], -7301.0, 0.5);
  EXPECT_NEAR(encoder_counts(omni::kEncoders, Eigen::Vector3d::Ones())[1], 3060.0, 1.0);
}

TEST(Encoders, CountFromWhereTheyWereReset) {
  const Eigen::Vector3d reset(0.1, -0.2, 0.3);
  EXPECT_EQ(encoder_counts(premium::kEncoders, reset, reset), Eigen::Vector3d::Zero());
  const Eigen::Vector3d counts = encoder_counts(premium::kEncoders, Eigen::Vector3d::Zero(), reset);
  EXPECT_LT((counts + encoder_counts(premium::kEncoders, reset)).norm(), 1e-9);
}

TEST(Encoders, RoundToTheNearestCount) {
  EXPECT_EQ(read_counters({0.49, -0.49, 0.51}), (std::array<int16_t, 3>{0, 0, 1}));
  EXPECT_EQ(read_counters({-0.51, 100.2, -100.8}), (std::array<int16_t, 3>{-1, 100, -101}));
}

TEST(Encoders, WrapAsSixteenBitCountersDo) {
  EXPECT_EQ(read_counters({32767.0, 32768.0, 32769.0}), (std::array<int16_t, 3>{32767, -32768, -32767}));
  EXPECT_EQ(read_counters({-32768.0, -32769.0, 65536.0}), (std::array<int16_t, 3>{-32768, 32767, 0}));
  EXPECT_EQ(read_counters({65535.0, -65537.0, 196609.0}), (std::array<int16_t, 3>{-1, -1, 1}));
}

TEST(Encoders, GiveTheFirmwareTheAnglesWithinHalfACount) {
  test::Random random(21);
  // Half a count, and the rounding of the fixed-point angles.
  const Eigen::Vector3d bound = Eigen::Vector3d(0.5 / 8670.0, 0.5 / 7301.0, 0.5 / 7301.0) * (1.0 + 1e-3);
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector3d q = test::random_posture(random, premium::kLimits);
    const auto counters = read_counters(encoder_counts(premium::kEncoders, q));
    const Eigen::Vector3d error = (seen_by_hal(counters) - q).cwiseAbs();
    ASSERT_TRUE((error.array() <= bound.array()).all()) << i;
  }
}

TEST(Encoders, GiveTheFirmwareTheTipWithinTheResolution) {
  test::Random random(22);
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector3d q = test::random_posture(random, premium::kLimits);
    const auto counters = read_counters(encoder_counts(premium::kEncoders, q));
    const auto angles =
        phantom::joint_angles(phantom::premium::kPremium15, {counters[0], counters[1], counters[2]});
    const auto tip = phantom::premium::tool_position(phantom::premium::posture(angles));
    const Eigen::Vector3d seen(sim::to_double(tip.x()), sim::to_double(tip.y()), sim::to_double(tip.z()));
    // Half a count of each joint with the tip at most 0.385 m from the axis.
    ASSERT_LT((seen - premium::tool_position(q)).norm(), 0.5 * 0.385 / 8670.0 + 0.5 * 0.385 / 7301.0);
  }
}

}  // namespace
}  // namespace palpate::plant
