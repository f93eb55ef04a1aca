// The arm's energy: kept without friction, lost with it, and changed by exactly the work done on it.
#include <gtest/gtest.h>

#include "arms.hpp"

namespace palpate::plant {
namespace {

using test::kNoTorque;
using test::kSubstep;
const ArmState kThrown{{0.2, 0.4, 0.9}, {4.0, -3.0, 5.0}};

/// The largest change of energy on the way, as part of the first kinetic energy.
double worst_drift(const ArmDynamics& arm, double seconds, double substep) {
  ArmState state = kThrown;
  const double start = arm.energy(state);
  const double kinetic = 0.5 * state.rates.dot(arm.mass_matrix(state.q) * state.rates);
  double worst = 0.0;
  for (int i = 0; i < std::lround(seconds / substep); ++i) {
    state = arm.advance(state, kNoTorque, {}, substep);
    worst = std::fmax(worst, std::fabs(arm.energy(state) - start) / kinetic);
  }
  return worst;
}

TEST(Energy, IsKeptWithoutFriction) {
  const ArmDynamics arm{test::frictionless_arm_without_stops()};
  const double worst = worst_drift(arm, 10.0, kSubstep);
  RecordProperty("worst_relative_drift", test::written(worst));
  EXPECT_LT(worst, 1e-12);
}

TEST(Energy, IsKeptWithAMassAtTheTip) {
  const ArmDynamics arm{test::frictionless_arm_without_stops()};
  TipLoad load;
  load.mass = 0.1;
  const auto energy = [&](const ArmState& state) {
    const Eigen::Vector3d velocity = premium::jacobian(state.q) * state.rates;
    return arm.energy(state) + 0.5 * load.mass * velocity.squaredNorm();
  };
  ArmState state = kThrown;
  const double start = energy(state);
  for (int i = 0; i < 20000; ++i) {
    state = arm.advance(state, kNoTorque, load, kSubstep);
    ASSERT_NEAR(energy(state), start, 1e-9 * start) << i;
  }
}

TEST(Energy, DriftsWithTheOrderOfTheIntegrator) {
  const ArmDynamics arm{test::frictionless_arm_without_stops()};
  const double coarse = worst_drift(arm, 1.0, 8e-3);
  const double fine = worst_drift(arm, 1.0, 4e-3);
  EXPECT_GT(fine, 1e-12);
  RecordProperty("order", test::written(std::log2(coarse / fine)));
  // Fourth order at least; what the method does to an oscillation's energy is of fifth.
  EXPECT_GT(std::log2(coarse / fine), 3.7);
  EXPECT_LT(std::log2(coarse / fine), 5.3);
}

TEST(Energy, IsKeptWithSpringyStopsUpToTheirEdges) {
  // A substep across a stop's edge errs like the spring's energy at one substep's depth: by the square of the
  // substep.
  ArmParameters parameters = test::frictionless_arm();
  parameters.stops.damping = 0.0;
  const ArmDynamics arm{parameters};
  const double worst = worst_drift(arm, 5.0, kSubstep);
  const double finer = worst_drift(arm, 5.0, kSubstep / 10.0);
  RecordProperty("worst_relative_drift", test::written(worst));
  RecordProperty("worst_relative_drift_at_100_kHz", test::written(finer));
  EXPECT_LT(worst, 3e-4);
  EXPECT_LT(finer, worst / 20.0);
}

TEST(Energy, OnlyFallsWithFriction) {
  const ArmDynamics arm{ArmParameters{}};
  ArmState state = kThrown;
  double last = arm.energy(state);
  for (int i = 0; i < 50000; ++i) {
    state = arm.advance(state, kNoTorque, {}, kSubstep);
    const double now = arm.energy(state);
    ASSERT_LE(now, last + 1e-15) << i;
    last = now;
  }
}

TEST(Energy, ChangesByTheWorkOfTorquesAndForces) {
  // dE = integral of (tau + J^T F) q' dt, by Simpson's rule over pairs of substeps.
  const ArmDynamics arm{test::frictionless_arm_without_stops()};
  const Eigen::Vector3d torques(0.02, -0.01, 0.015);
  TipLoad load;
  load.force = {0.1, -0.2, 0.15};
  const auto power = [&](const ArmState& state) {
    return state.rates.dot(torques + premium::jacobian(state.q).transpose() * load.force);
  };
  ArmState state = kThrown;
  const double start = arm.energy(state);
  double work = 0.0;
  for (int i = 0; i < 5000; ++i) {
    const ArmState middle = arm.advance(state, torques, load, kSubstep);
    const ArmState end = arm.advance(middle, torques, load, kSubstep);
    work += kSubstep / 3.0 * (power(state) + 4.0 * power(middle) + power(end));
    state = end;
  }
  const double gained = arm.energy(state) - start;
  EXPECT_GT(std::fabs(gained), 1e-3);
  EXPECT_NEAR(work, gained, 1e-9);
}

}  // namespace
}  // namespace palpate::plant
