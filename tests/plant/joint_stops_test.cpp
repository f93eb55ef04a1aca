#include "plant/joint_stops.hpp"

#include <gtest/gtest.h>

#include "arms.hpp"

namespace palpate::plant {
namespace {

using test::kNoTorque;
using test::kSubstep;

Eigen::Vector3d in_degrees(double q1, double q2, double q3) {
  return {radians(q1), radians(q2), radians(q3)};
}

TEST(JointStops, DoNothingWithinTheLimits) {
  test::Random random(51);
  const JointStops stops;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d q = test::random_posture(random, premium::kLimits);
    ASSERT_EQ(stops.torques(q, 10.0 * random.vector()), kNoTorque);
    ASSERT_EQ(stops.energy(q), 0.0);
  }
}

TEST(JointStops, PushBackAtEachEnd) {
  const JointStops stops;
  const double push = 10.0 * radians(1.0);
  const auto expect = [&](const Eigen::Vector3d& q, const Eigen::Vector3d& torques) {
    EXPECT_LT((stops.torques(q, kNoTorque) - torques).norm(), 1e-12) << q[0] << " " << q[1] << " " << q[2];
    EXPECT_NEAR(stops.energy(q), 5.0 * radians(1.0) * radians(1.0), 1e-12);
  };
  expect(in_degrees(91, 0, 0), {-push, 0, 0});
  expect(in_degrees(-91, 0, 0), {push, 0, 0});
  expect(in_degrees(0, 120, 120), {0, -push, 0});
  expect(in_degrees(0, -30, -30), {0, 0, push});
  expect(in_degrees(0, 66, 0), {0, -push, push});
  expect(in_degrees(0, 0, 56), {0, push, -push});
  // q2 = -125 and q3 = 215 degrees are behind the other limits: the fold's is met first.
  JointStops unfolded;
  unfolded.limits.fold = test::kNoLimits.fold;
  EXPECT_NEAR(unfolded.torques(in_degrees(0, -125, 0), kNoTorque)[1], push, 1e-12);
  EXPECT_NEAR(unfolded.torques(in_degrees(0, 0, 215), kNoTorque)[2], -push, 1e-12);
}

TEST(JointStops, DampAndNeverPull) {
  const JointStops stops;
  const Eigen::Vector3d q = in_degrees(91, 0, 0);
  const double push = 10.0 * radians(1.0);
  EXPECT_NEAR(stops.torques(q, {1.0, 0, 0})[0], -push - 0.1, 1e-12);
  EXPECT_NEAR(stops.torques(q, {-1.0, 0, 0})[0], -push + 0.1, 1e-12);
  EXPECT_EQ(stops.torques(q, {-2.0, 0, 0})[0], 0.0);
}

/// An inertia I alone on a stop: until the torque is 0 it is a damped oscillator, and leaves with
///   rate(out) / rate(in) = exp(-2 zeta acos(zeta) / sqrt(1 - zeta^2)),  zeta = b / (2 sqrt(k I))
TEST(JointStops, ReturnAnInertiaWithTheClosedFormSpeed) {
  const JointStops stops;
  for (const double inertia : {1e-3, 2.5e-3, 4e-3}) {
    const double zeta = stops.damping / (2.0 * std::sqrt(stops.stiffness * inertia));
    const double expected = std::exp(-2.0 * zeta * std::acos(zeta) / std::sqrt(1.0 - zeta * zeta));
    double angle = stops.limits.q1.high;
    double rate = 2.0;
    constexpr double kStep = 1e-6;
    do {  // midpoint rule
      const auto slope = [&](double at, double speed) {
        return stops.torques({at, 0, 0}, {speed, 0, 0})[0] / inertia;
      };
      const double middle_angle = angle + 0.5 * kStep * rate;
      const double middle_rate = rate + 0.5 * kStep * slope(angle, rate);
      angle += kStep * middle_rate;
      rate += kStep * slope(middle_angle, middle_rate);
    } while (angle > stops.limits.q1.high);
    EXPECT_NEAR(-rate / 2.0, expected, 1e-4) << inertia;
  }
}

TEST(JointStops, HoldTheArmAgainstItsWeight) {
  // Counterweights turn the free links until stops hold them: the arm rests where springs balance gravity.
  const ArmDynamics arm{ArmParameters{}};
  ArmState state{in_degrees(10, 20, 30), kNoTorque};
  for (int i = 0; i < 100000; ++i) state = arm.advance(state, kNoTorque, {}, kSubstep);
  EXPECT_LT(state.rates.norm(), 1e-3);
  const double weight = 0.01630 + 0.07376;
  EXPECT_GE(margin_to_limits(premium::kLimits, state.q), -weight / 10.0);
  EXPECT_LT(margin_to_limits(premium::kLimits, state.q), 0.0);
}

TEST(JointStops, HoldTheTurretAgainstTheStrongestMotor) {
  // 5.5 A at the turret are 1.71 N m: 0.171 rad into the stop, and no further than twice that on impact.
  ArmParameters parameters;
  parameters.gravity = 0.0;
  const ArmDynamics arm{parameters};
  const Eigen::Vector3d torques(13.3 * 0.0234 * 5.5, 0, 0);
  ArmState state{in_degrees(89, 0, 20), kNoTorque};
  double deepest = 0.0;
  for (int i = 0; i < 50000; ++i) {
    state = arm.advance(state, torques, {}, kSubstep);
    deepest = std::fmax(deepest, state.q[0] - premium::kLimits.q1.high);
  }
  EXPECT_NEAR(state.q[0] - premium::kLimits.q1.high, torques[0] / 10.0, 1e-4);
  EXPECT_LT(deepest, 2.2 * torques[0] / 10.0);
}

TEST(JointStops, TakeNoMoreThanTheirDampingExplains) {
  // Into the turret's stop and out again without friction: between nothing and the integral of b q'^2.
  ArmParameters parameters = test::frictionless_arm();
  parameters.gravity = 0.0;
  const ArmDynamics arm{parameters};
  ArmState state{in_degrees(89, 10, 20), {3.0, 0, 0}};
  const double start = arm.energy(state);
  double last = start;
  double damped = 0.0;
  bool has_touched = false;
  for (int i = 0; i < 2000; ++i) {
    const double before = state.rates[0];
    const bool is_in = state.q[0] > premium::kLimits.q1.high;
    state = arm.advance(state, kNoTorque, {}, kSubstep);
    if (is_in) damped += 0.5 * kSubstep * 0.1 * (before * before + state.rates[0] * state.rates[0]);
    has_touched = has_touched || is_in;
    const double now = arm.energy(state);
    ASSERT_LE(now, last + 1e-5 * start) << i;
    last = now;
    if (has_touched && !is_in) break;
  }
  ASSERT_TRUE(has_touched);
  EXPECT_LT(state.rates[0], 0.0);
  EXPECT_LT(last, 0.9 * start);
  EXPECT_GE(last, start - damped - 1e-3 * start);
}

}  // namespace
}  // namespace palpate::plant
