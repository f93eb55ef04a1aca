// The arm under gravity, torques and forces.
#include <gtest/gtest.h>

#include "arms.hpp"

namespace palpate::plant {
namespace {

using test::kNoTorque;
using test::kSubstep;

ArmState run(const ArmDynamics& arm, ArmState state, const Eigen::Vector3d& torques, double seconds,
             double substep) {
  const auto steps = static_cast<int>(std::lround(seconds / substep));
  for (int i = 0; i < steps; ++i) state = arm.advance(state, torques, {}, substep);
  return state;
}

TEST(FreeFall, StartsWithTheAccelerationOfGravity) {
  test::Random random(41);
  const ArmDynamics arm{ArmParameters{}};
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d q = test::random_posture(random, premium::kLimits);
    const Eigen::Vector3d expected = -arm.mass_matrix(q).inverse() * arm.bodies().gravity_torques(q);
    ASSERT_LT((arm.acceleration({q, kNoTorque}, kNoTorque, {}, 0.0) - expected).norm(), 1e-10);
  }
}

TEST(FreeFall, IsHalfAccelerationTimesTimeSquaredAtFirst) {
  const ArmDynamics arm{test::frictionless_arm_without_stops()};
  test::Random random(42);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d q = test::random_posture(random, premium::kLimits);
    const Eigen::Vector3d acceleration = -arm.mass_matrix(q).inverse() * arm.bodies().gravity_torques(q);
    const auto error = [&](double seconds) {
      const ArmState fallen = run(arm, {q, kNoTorque}, kNoTorque, seconds, kSubstep);
      return (fallen.q - q - 0.5 * acceleration * seconds * seconds).norm();
    };
    // The next term of the series is the fourth power of time: q''' is 0 at rest.
    const double at_4_ms = error(4e-3);
    const double at_8_ms = error(8e-3);
    ASSERT_LT(at_8_ms, 0.01 * acceleration.norm() * 32e-6);
    if (at_4_ms > 1e-10) {
      ASSERT_NEAR(at_8_ms / at_4_ms, 16.0, 0.5);
    }
  }
}

TEST(FreeFall, SwingsWithThePeriodOfThePendulum) {
  // Around its stable equilibrium (counterweights down: q3 = 180, q2 = 90 degrees) the links' small motions
  // are M q'' + K q = 0 with K = diag(d2U/dq2).
  const ArmDynamics arm{test::frictionless_arm_without_stops()};
  const Eigen::Vector3d rest(0.0, kPi / 2.0, kPi);
  ASSERT_LT(arm.bodies().gravity_torques(rest).norm(), 1e-15);
  const Eigen::Matrix2d M = arm.mass_matrix(rest).bottomRightCorner<2, 2>();
  Eigen::Matrix2d K = Eigen::Matrix2d::Zero();
  for (Eigen::Index joint = 0; joint < 2; ++joint) {
    const auto torques = [&arm](const Eigen::Vector3d& q) { return arm.bodies().gravity_torques(q); };
    K(joint, joint) = test::slope_along<Eigen::Vector3d>(torques, rest, joint + 1, 1e-3)[joint + 1];
  }
  ASSERT_GT(K(0, 0), 0.0);
  ASSERT_GT(K(1, 1), 0.0);
  // A mode v of M^-1 K = w^2: the upper row gives v from w^2, and w^2 solves the characteristic equation.
  const Eigen::Matrix2d A = M.inverse() * K;
  const double half_trace = 0.5 * (A(0, 0) + A(1, 1));
  const double square =
      half_trace + std::sqrt(half_trace * half_trace - A(0, 0) * A(1, 1) + A(0, 1) * A(1, 0));
  const Eigen::Vector2d mode = Eigen::Vector2d(A(0, 1), square - A(0, 0)).normalized();
  constexpr double kAmplitude = 1e-4;
  ArmState state{rest + kAmplitude * Eigen::Vector3d(0.0, mode[0], mode[1]), kNoTorque};
  for (int step = 1; step <= 10000; ++step) {
    state = arm.advance(state, kNoTorque, {}, kSubstep);
    const double expected = kAmplitude * std::cos(std::sqrt(square) * step * kSubstep);
    const Eigen::Vector2d away = (state.q - rest).tail<2>();
    ASSERT_NEAR(away.dot(mode), expected, 1e-3 * kAmplitude) << step;
  }
}

TEST(ArmMotion, ConvergesWithTheFourthOrder) {
  const ArmDynamics arm{test::frictionless_arm_without_stops()};
  const ArmState start{{0.2, 0.4, 0.9}, {4.0, -3.0, 5.0}};
  const Eigen::Vector3d torques(0.02, -0.01, 0.015);
  const ArmState exact = run(arm, start, torques, 0.2, 1e-4);
  const auto error = [&](double substep) {
    const ArmState reached = run(arm, start, torques, 0.2, substep);
    return (reached.q - exact.q).norm() + (reached.rates - exact.rates).norm();
  };
  const double coarse = error(4e-3);
  const double fine = error(2e-3);
  EXPECT_GT(coarse, 1e-9);
  RecordProperty("order", test::written(std::log2(coarse / fine)));
  EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.3);
}

TEST(ArmMotion, StandsStillWhereTorquesBalanceGravityAndForce) {
  const ArmDynamics arm{test::frictionless_arm()};
  test::Random random(43);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d q = test::random_posture(random, premium::kLimits);
    TipLoad load;
    load.force = random.vector();
    const Eigen::Vector3d torques =
        arm.bodies().gravity_torques(q) - premium::jacobian(q).transpose() * load.force;
    ASSERT_LT(arm.acceleration({q, kNoTorque}, torques, load, 0.0).norm(), 1e-10);
    ASSERT_LT((arm.tip_force({q, kNoTorque}, torques, load) - load.force).norm(), 1e-12);
  }
}

TEST(ArmMotion, AMassAtTheTipIsFeltThere) {
  // Pushed up at the zero pose, 55 g of arm and 100 g of load: F = (m + M) a.
  ArmParameters parameters = test::frictionless_arm_without_stops();
  parameters.gravity = 0.0;
  const ArmDynamics arm{parameters};
  TipLoad load;
  load.force = {0.0, 0.0, 1.0};
  load.mass = 0.1;
  const Eigen::Matrix3d J = premium::jacobian(Eigen::Vector3d::Zero());
  const Eigen::Vector3d acceleration = J * arm.acceleration({}, kNoTorque, load, 0.0);
  const double arm_mass = arm.mass_matrix(Eigen::Vector3d::Zero())(1, 1) / (0.215 * 0.215);
  EXPECT_NEAR(acceleration[2], 1.0 / (0.1 + arm_mass), 1e-6);
  // What the load passes on is what moves the arm.
  EXPECT_NEAR(arm.tip_force({}, kNoTorque, load)[2], arm_mass * acceleration[2], 1e-6);
}

TEST(ArmMotion, ALoadsAnchorMovesWithinASubstep) {
  const ArmDynamics arm{test::frictionless_arm_without_stops()};
  TipLoad load;
  load.anchor = premium::tool_position(Eigen::Vector3d::Zero());
  load.anchor_velocity = {0.1, 0.5, -0.3};
  load.stiffness = 300.0;
  constexpr int kPieces = 10;
  const ArmState whole = arm.advance({}, kNoTorque, load, kSubstep);
  ArmState pieces;
  for (int i = 0; i < kPieces; ++i) {
    pieces = arm.advance(pieces, kNoTorque, load, kSubstep / kPieces);
    load.anchor += load.anchor_velocity * kSubstep / kPieces;
  }
  EXPECT_GT(whole.rates.norm(), 1e-5);
  EXPECT_LT((whole.rates - pieces.rates).norm(), 1e-5 * whole.rates.norm());
}

TEST(ArmMotion, SlowsDownByViscousFriction) {
  // The turret alone, links where M11 does not change to first order: q1' = q1'(0) exp(-B t / M11).
  ArmParameters parameters = test::frictionless_arm_without_stops();
  parameters.gravity = 0.0;
  parameters.friction.viscous = 0.0005;
  const ArmDynamics arm{parameters};
  const double inertia = arm.mass_matrix(Eigen::Vector3d::Zero())(0, 0);
  const ArmState slowed = run(arm, {kNoTorque, {1e-3, 0.0, 0.0}}, kNoTorque, 2.0, kSubstep);
  EXPECT_NEAR(slowed.rates[0] / 1e-3, std::exp(-0.0005 * 2.0 / inertia), 1e-6);
}

TEST(ArmMotion, CoulombFrictionStopsAtItsConstantRate) {
  // Far above 1/steepness the friction is F: the turret loses F / M11 a second.
  ArmParameters parameters = test::frictionless_arm_without_stops();
  parameters.gravity = 0.0;
  parameters.friction.coulomb = 0.01;
  const ArmDynamics arm{parameters};
  const Eigen::Vector3d slowing = arm.acceleration({kNoTorque, {3.0, 0.0, 0.0}}, kNoTorque, {}, 0.0);
  EXPECT_NEAR(slowing[0] * arm.mass_matrix(Eigen::Vector3d::Zero())(0, 0), -0.01, 1e-12);
}

}  // namespace
}  // namespace palpate::plant
