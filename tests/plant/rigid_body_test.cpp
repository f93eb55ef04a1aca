#include "plant/rigid_body.hpp"

#include <gtest/gtest.h>

#include <array>

#include "arms.hpp"

namespace palpate::plant {
namespace {

constexpr double kGravity = 9.81;

RigidBody premium_body() { return {PremiumBodies{}, kGravity}; }

/// A body of which the inertia is about `centre`, which moves with both links in the plane of the arm:
/// reach = a c2 + b s3, height = a s2 - b c3; the body leans by q2 or q3.
struct MovedBody {
  Body body;
  double along_upper, along_fore;
  Eigen::Index leans_with;
};

std::array<MovedBody, 4> moved_bodies() {
  const PremiumBodies all;
  return {MovedBody{all.a, all.l1, all.l2 / 2.0, 2}, MovedBody{all.c, all.l1 / 2.0, all.l3, 1},
          MovedBody{all.be, 0.0, 0.0, 1}, MovedBody{all.df, 0.0, 0.0, 2}};
}

/// From the velocities of the bodies, without any matrix.
double kinetic_energy_by_bodies(const Eigen::Vector3d& q, const Eigen::Vector3d& rates) {
  double twice = PremiumBodies{}.base_inertia_y * rates[0] * rates[0];
  for (const auto& [body, upper, fore, leans_with] : moved_bodies()) {
    const double around = rates[0] * (upper * std::cos(q[1]) + fore * std::sin(q[2]));
    const double out = -upper * std::sin(q[1]) * rates[1] + fore * std::cos(q[2]) * rates[2];
    const double up = upper * std::cos(q[1]) * rates[1] + fore * std::sin(q[2]) * rates[2];
    const double lean = q[leans_with];
    const double about_y = rates[0] * std::cos(lean), about_z = rates[0] * std::sin(lean);
    const double about_x = rates[leans_with];
    twice += body.mass * (around * around + out * out + up * up) + body.inertia_x * about_x * about_x +
             body.inertia_y * about_y * about_y + body.inertia_z * about_z * about_z;
  }
  return twice / 2.0;
}

TEST(RigidBodies, HaveThePublishedReducedForm) {
  const RigidBody body = premium_body();
  const auto m = [&body](double q2, double q3) { return body.mass_matrix({0.3, q2, q3}); };
  const double a0 = 2.832788e-3, a1 = 1.131893e-3, a2 = -3.912007e-4, a3 = 9.122987e-4;
  for (double q2 = -2.0; q2 < 2.0; q2 += 0.37) {
    for (double q3 = -0.5; q3 < 3.7; q3 += 0.41) {
      const Eigen::Matrix3d M = m(q2, q3);
      const double m11 =
          a0 + a1 * std::cos(2 * q2) + a2 * std::cos(2 * q3) + a3 * std::cos(q2) * std::sin(q3);
      EXPECT_NEAR(M(0, 0), m11, 3e-9);
      EXPECT_NEAR(M(1, 1), 2.426396e-3, 1e-9);
      EXPECT_NEAR(M(2, 2), 9.318856e-4, 1e-10);
      EXPECT_NEAR(M(1, 2), -a3 / 2 * std::sin(q2 - q3), 1e-10);
      EXPECT_EQ(M(1, 2), M(2, 1));
      EXPECT_EQ(M(0, 1), 0.0);
      EXPECT_EQ(M(0, 2), 0.0);
      const Eigen::Vector3d G = body.gravity_torques({0.3, q2, q3});
      EXPECT_EQ(G[0], 0.0);
      EXPECT_NEAR(G[1], -0.01630 * std::cos(q2), 5e-6);
      EXPECT_NEAR(G[2], -0.07376 * std::sin(q3), 5e-6);
    }
  }
}

TEST(RigidBodies, HaveTheEnergyOfTheirParts) {
  test::Random random(31);
  const RigidBody body = premium_body();
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d q = 3.0 * random.vector();
    const Eigen::Vector3d rates = 5.0 * random.vector();
    const double expected = kinetic_energy_by_bodies(q, rates);
    ASSERT_NEAR(0.5 * rates.dot(body.mass_matrix(q) * rates), expected, 1e-15 + 1e-12 * expected);
  }
}

TEST(RigidBodies, HaveAPositiveMassEverywhere) {
  test::Random random(32);
  const RigidBody body = premium_body();
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Matrix3d M = body.mass_matrix(test::random_posture(random, premium::kLimits));
    ASSERT_GT(M(0, 0), 0.0);
    ASSERT_GT(M(1, 1) * M(2, 2) - M(1, 2) * M(2, 1), 0.0);
  }
}

/// V_i = sum_jk (dM_ij/dq_k - 1/2 dM_jk/dq_i) q_j' q_k'.
TEST(RigidBodies, VelocityTorquesAgreeWithChristoffel) {
  test::Random random(33);
  const RigidBody body = premium_body();
  double worst = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d q = test::random_posture(random, premium::kLimits);
    const Eigen::Vector3d rates = 4.0 * random.vector();
    std::array<Eigen::Matrix3d, 3> slopes;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto mass_matrix = [&body](const Eigen::Vector3d& at) { return body.mass_matrix(at); };
      slopes[k] = test::slope_along<Eigen::Matrix3d>(mass_matrix, q, static_cast<Eigen::Index>(k), 1e-3);
    }
    Eigen::Vector3d expected = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      expected += slopes[k] * rates * rates[axis];
      expected[axis] -= 0.5 * rates.dot(slopes[k] * rates);
    }
    worst = std::fmax(worst, (body.velocity_torques(q, rates) - expected).cwiseAbs().maxCoeff());
  }
  RecordProperty("worst_newton_metre", test::written(worst));
  EXPECT_LT(worst, 3e-12);
}

TEST(RigidBodies, GravityIsTheSlopeOfThePotential) {
  test::Random random(34);
  const RigidBody body = premium_body();
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d q = 3.0 * random.vector();
    const auto potential = [&body](const Eigen::Vector3d& at) { return body.potential_energy(at); };
    for (Eigen::Index joint = 0; joint < 3; ++joint) {
      ASSERT_NEAR(test::slope_along<double>(potential, q, joint, 1e-3), body.gravity_torques(q)[joint],
                  1e-12);
    }
  }
}

TEST(RigidBodies, HaveThePotentialOfTheirCentres) {
  const PremiumBodies all;
  const RigidBody body = premium_body();
  const auto height = [](const Eigen::Vector3d& q, double upper, double fore) {
    return upper * std::sin(q[1]) - fore * std::cos(q[2]);
  };
  test::Random random(35);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d q = 3.0 * random.vector();
    const double expected =
        kGravity *
        (all.a.mass * height(q, all.l1, all.l2 / 2.0) + all.c.mass * height(q, all.l1 / 2.0, all.l3) +
         all.be.mass * height(q, all.l5, 0.0) + all.df.mass * height(q, 0.0, -all.l6));
    ASSERT_NEAR(body.potential_energy(q), expected, 1e-14);
  }
}

TEST(RigidBodies, FeelLikeThePublishedMassesAtTheTip) {
  const ArmDynamics arm{ArmParameters{}};
  const Eigen::Matrix3d M = arm.mass_matrix(Eigen::Vector3d::Zero());
  const Eigen::Matrix3d J = premium::jacobian(Eigen::Vector3d::Zero());
  const Eigen::Matrix3d mobility = J * M.inverse() * J.transpose();
  EXPECT_NEAR(1e3 / mobility(0, 0), 37.0, 0.5);
  EXPECT_NEAR(1e3 / mobility(1, 1), 81.0, 0.5);
  EXPECT_NEAR(1e3 / mobility(2, 2), 55.0, 0.5);
}

}  // namespace
}  // namespace palpate::plant
