// Both devices' kinematics in double precision.
#include <gtest/gtest.h>

#include "arms.hpp"
#include "plant/omni.hpp"
#include "plant/premium.hpp"

namespace palpate::plant {
namespace {

constexpr int kPostures = 20000;

double reach(const Links& links, const Eigen::Vector3d& q) {
  return links.upper * std::cos(q[1]) + links.fore * std::sin(q[2]);
}

/// Postures that the inverse can tell from their mirror image: the arm reaches forward, the elbow is bent.
template <class Visit>
int for_random_postures(const JointLimits& limits, const Links& links, Visit visit) {
  test::Random random(11);
  int visited = 0;
  for (int i = 0; i < kPostures; ++i) {
    const Eigen::Vector3d q = test::random_posture(random, limits);
    if (reach(links, q) < 0.02) continue;
    ++visited;
    visit(q);
  }
  return visited;
}

TEST(PremiumKinematics, HasItsZeroPose) {
  const Eigen::Vector3d tip = premium::tool_position(Eigen::Vector3d::Zero());
  EXPECT_NEAR((tip - Eigen::Vector3d(0.215, 0.0, -0.170)).norm(), 0.0, 1e-10);
}

TEST(PremiumKinematics, ReturnsThroughTheInverse) {
  double worst = 0.0;
  const int visited = for_random_postures(premium::kLimits, premium::links(), [&](const Eigen::Vector3d& q) {
    const auto again = premium::inverse_kinematics(premium::tool_position(q));
    ASSERT_TRUE(again.has_value());
    worst = std::fmax(worst, (*again - q).cwiseAbs().maxCoeff());
  });
  EXPECT_GT(visited, kPostures / 2);
  RecordProperty("worst_radian", test::written(worst));
  EXPECT_LT(worst, 1e-12);
}

TEST(PremiumKinematics, JacobianIsTheDerivative) {
  for_random_postures(premium::kLimits, premium::links(), [](const Eigen::Vector3d& q) {
    const Eigen::Matrix3d J = premium::jacobian(q);
    for (Eigen::Index joint = 0; joint < 3; ++joint) {
      const auto slope = test::slope_along<Eigen::Vector3d>(premium::tool_position, q, joint, 1e-3);
      ASSERT_LT((slope - J.col(joint)).norm(), 1e-11);
    }
  });
}

TEST(PremiumKinematics, AccelerationAtConstantRatesIsTheSecondDerivative) {
  test::Random random(12);
  for_random_postures(premium::kLimits, premium::links(), [&random](const Eigen::Vector3d& q) {
    const Eigen::Vector3d rates = 3.0 * random.vector();
    const auto velocity_later = [&](const Eigen::Vector3d& time) -> Eigen::Vector3d {
      return premium::jacobian(q + time[0] * rates) * rates;
    };
    const auto slope = test::slope_along<Eigen::Vector3d>(velocity_later, Eigen::Vector3d::Zero(), 0, 1e-3);
    const auto exact = arm_acceleration_at_constant_rates(premium::links(), q, rates);
    ASSERT_LT((slope - exact).norm(), 1e-8);
  });
}

TEST(PremiumKinematics, SaysWhatIsOutOfReach) {
  EXPECT_TRUE(premium::inverse_kinematics({0.384, 0.0, 0.0}).has_value());
  EXPECT_FALSE(premium::inverse_kinematics({0.386, 0.0, 0.0}).has_value());
  EXPECT_TRUE(premium::inverse_kinematics({0.046, 0.0, 0.0}).has_value());
  EXPECT_FALSE(premium::inverse_kinematics({0.044, 0.0, 0.0}).has_value());
  EXPECT_FALSE(premium::inverse_kinematics({0.0, 0.0, 0.0}).has_value());
}

TEST(PremiumKinematics, KnowsItsLimits) {
  const auto margin_deg = [](double q1, double q2, double q3) {
    return degrees(margin_to_limits(premium::kLimits, {radians(q1), radians(q2), radians(q3)}));
  };
  EXPECT_NEAR(margin_deg(0, 0, 0), 29.0, 1e-9);     // q3
  EXPECT_NEAR(margin_deg(-85, 0, 0), 5.0, 1e-9);    // q1
  EXPECT_NEAR(margin_deg(0, 118, 100), 1.0, 1e-9);  // q2
  EXPECT_NEAR(margin_deg(0, 60, 0), 5.0, 1e-9);     // q2 - q3 at 60 of 65
  EXPECT_NEAR(margin_deg(0, 0, 57), -2.0, 1e-9);    // q3 - q2 at 57 of 55
}

TEST(OmniKinematics, HasThePublishedUncalibratedPose) {
  const Eigen::Vector3d tip = omni::tool_position(Eigen::Vector3d::Zero());
  EXPECT_NEAR((tip - Eigen::Vector3d(0.0, -0.110, -0.035)).norm(), 0.0, 1e-8);
}

TEST(OmniKinematics, HasItsOriginInTheMiddleOfTheWorkspace) {
  const Eigen::Vector3d tip = omni::tool_position({0.0, radians(42.5), radians(31.7)});
  EXPECT_LT(tip.norm(), 2e-4);
}

TEST(OmniKinematics, ReturnsThroughTheInverse) {
  double worst = 0.0;
  const int visited = for_random_postures(omni::kLimits, omni::links(), [&](const Eigen::Vector3d& q) {
    const auto again = omni::inverse_kinematics(omni::tool_position(q));
    ASSERT_TRUE(again.has_value());
    worst = std::fmax(worst, (*again - q).cwiseAbs().maxCoeff());
  });
  EXPECT_GT(visited, kPostures / 2);
  RecordProperty("worst_radian", test::written(worst));
  EXPECT_LT(worst, 1e-12);
}

TEST(OmniKinematics, JacobianIsTheDerivative) {
  for_random_postures(omni::kLimits, omni::links(), [](const Eigen::Vector3d& q) {
    const Eigen::Matrix3d J = omni::jacobian(q);
    for (Eigen::Index joint = 0; joint < 3; ++joint) {
      const auto slope = test::slope_along<Eigen::Vector3d>(omni::tool_position, q, joint, 1e-3);
      ASSERT_LT((slope - J.col(joint)).norm(), 1e-11);
    }
  });
}

TEST(OmniKinematics, HasItsAxes) {
  const Eigen::Matrix3d J = omni::jacobian(Eigen::Vector3d::Zero());
  EXPECT_NEAR(J(0, 0), -0.13335, 1e-9);  // the waist turns the tip to the left
  EXPECT_NEAR(J(1, 1), 0.13335, 1e-9);   // the shoulder lifts it
  EXPECT_NEAR(J(2, 2), 0.13335, 1e-9);   // the elbow brings it to the user
}

TEST(OmniForce, IsLimitedInItsDirection) {
  const Eigen::Vector3d small(1.0, -2.0, 2.0);
  EXPECT_EQ(omni::within_peak_force(small), small);
  const Eigen::Vector3d limited = omni::within_peak_force({10.0, -20.0, 20.0});
  EXPECT_NEAR(limited.norm(), 3.3, 1e-12);
  EXPECT_LT((limited - 1.1 * small).norm(), 1e-12);
  EXPECT_TRUE(omni::is_continuous({0.0, 0.87, 0.0}));
  EXPECT_FALSE(omni::is_continuous({0.6, 0.6, 0.6}));
}

}  // namespace
}  // namespace palpate::plant
