// The passivity observer and controller against doubles: energy is never below zero unless a limit stood in
// the way, and what it does is no more than needed.
#include "palpate/touch/passivity.hpp"

#include <gtest/gtest.h>

#include "support/fixed.hpp"
#include "support/random.hpp"
#include "support/soak.hpp"

namespace palpate::test {
namespace {

using Eigen::Vector3d;

constexpr double kEnergyLsb = 1.0 / (int64_t{1} << 40);

double in_doubles(Energy energy) { return std::ldexp(static_cast<double>(energy.raw()), -40); }

PassivityRules generous() { return PassivityRules{1u << 20, Coupling::max()}; }

/// Controller and observer, with nothing between.
Vector3<Force> keep_passive(const PassivityRules& rules, const Vector3<Force>& force,
                            const Vector3<Position>& moved, Passivity& passivity) {
  Vector3<Force> passive = made_passive(rules, force, moved, passivity);
  observe(rules, passive, moved, passivity);
  return passive;
}

/// Forces and motions of all sizes; a body that gives on average, so that the controller works all the time.
TEST(TouchPassivity, EnergyIsNeverBelowZero) {
  Random random(331);
  Passivity passivity = Passivity::at_rest();
  double exact = 0.0;
  uint32_t braking = 0;
  double worst = 0.0;
  double most = 0.0;
  const uint32_t ticks = in_soak(5000000u, 100000u);
  for (uint32_t i = 0; i < ticks; ++i) {
    // From 2^-13 edge a tick on the force that brakes is within its limit.
    const auto moved =
        fixed_vector<Position>(Vector3d(std::exp2(-5.0 - 5.0 * random.unit()) * random.direction()));
    const double size = std::exp2(-2.0 - 10.0 * random.unit());
    const Vector3d wanted = size * (random.vector() + 0.2 * doubles(moved).normalized());
    const auto force = fixed_vector<Force>(wanted);
    const double before = in_doubles(passivity.energy);
    const double without = before - doubles(force).dot(doubles(moved));
    const Vector3<Force> out = keep_passive(generous(), force, moved, passivity);
    ASSERT_GE(passivity.energy.raw(), 0) << i;
    exact += -doubles(out).dot(doubles(moved));
    if (passivity.energy.raw() == int64_t{1} << 40) exact = 1.0;
    braking += passivity.is_braking ? 1u : 0u;
    ASSERT_EQ(passivity.is_braking, out != force);
    if (!passivity.is_braking) {
      ASSERT_GE(without, -1.0 * kEnergyLsb);
      continue;
    }
    // Against the motion, and no more than was missing: to a step of force in each component.
    const Vector3d brake = doubles(out) - doubles(force);
    ASSERT_LE(brake.dot(doubles(moved)), 0.0);
    ASSERT_LE(brake.cross(doubles(moved)).norm(), 4 * kForceLsb * doubles(moved).norm());
    const double missing = -without / doubles(moved).norm();
    ASSERT_GE(brake.norm(), missing - 1e-9);
    ASSERT_LE(brake.norm(), missing * (1 + 1e-7) + 4 * kForceLsb);
    worst = std::max(worst, in_doubles(passivity.energy) / (kForceLsb * doubles(moved).lpNorm<1>()));
    most = std::max(most, brake.norm());
  }
  // The observer rounds up: by less than an LSB a tick.
  EXPECT_NEAR(in_doubles(passivity.energy), exact, ticks * kEnergyLsb);
  std::printf("braked in %u of %u ticks, with up to %.3f; energy left: at most %.2f steps of force\n",
              braking, ticks, most, worst);
  EXPECT_GT(braking, ticks / 20);
  EXPECT_LT(braking, ticks * 19 / 20);
}

/// What a limit leaves undone stays in the energy, and is made up for as soon as there is room.
TEST(TouchPassivity, LimitsLeaveADebtThatIsPaid) {
  PassivityRules rules = generous();
  rules.most_damping = Coupling::ratio(2, 1);
  Passivity passivity = Passivity::at_rest();
  const auto moved = fixed_vector<Position>(Vector3d(0.01, 0, 0));
  const auto push = fixed_vector<Force>(Vector3d(0.5, 0, 0));
  const Vector3<Force> out = keep_passive(rules, push, moved, passivity);
  EXPECT_NEAR(sim::to_double(out[0]), 0.48, 1e-6);
  EXPECT_NEAR(in_doubles(passivity.energy), -0.0048, 1e-8);
  int ticks = 0;
  while (passivity.energy.raw() < 0 && ticks < 1000) {
    const Vector3<Force> braked = keep_passive(rules, zero_vector<Force>(), moved, passivity);
    ASSERT_LT(braked[0].raw(), 0);
    ++ticks;
  }
  EXPECT_EQ(ticks, 24);  // 0.0048 in steps of 2 x 0.01^2
  EXPECT_EQ(keep_passive(rules, zero_vector<Force>(), moved, passivity), zero_vector<Force>());
}

TEST(TouchPassivity, AtATinyStepThereIsNoBraking) {
  Passivity passivity = Passivity::at_rest();
  const auto push = fixed_vector<Force>(Vector3d(1, 0, 0));
  const Position zero = Position::from_raw(0);
  const Vector3<Position> tiny(kLeastStep - Position::from_raw(1), zero, zero);
  EXPECT_EQ(keep_passive(generous(), push, tiny, passivity), push);
  EXPECT_LT(passivity.energy.raw(), 0);
  EXPECT_FALSE(passivity.is_braking);
  EXPECT_EQ(keep_passive(generous(), push, zero_vector<Position>(), passivity), push);
  const Vector3<Position> least(kLeastStep, zero, zero);
  keep_passive(generous(), push, least, passivity);
  EXPECT_TRUE(passivity.is_braking);
}

/// Energy is kept up to the ceiling and not beyond; a body may give back no more than that.
TEST(TouchPassivity, EnergySaturatesAtItsCeiling) {
  PassivityRules rules = generous();
  rules.ceiling = 1000;
  Passivity passivity = Passivity::at_rest();
  const auto moved = fixed_vector<Position>(Vector3d(0.01, 0, 0));
  for (int i = 0; i < 100; ++i)
    keep_passive(rules, fixed_vector<Force>(Vector3d(-0.5, 0, 0)), moved, passivity);
  EXPECT_EQ(passivity.energy.raw(), int64_t{1000} << 20);
  EXPECT_NEAR(in_doubles(passivity.energy), 1000.0 / (1 << 20), 1e-12);
  rules.most_damping = Coupling::from_raw(0);
  for (int i = 0; i < 100; ++i) {
    const auto force = fixed_vector<Force>(Vector3d(0.5, 0, 0));
    EXPECT_EQ(keep_passive(rules, force, moved, passivity), force) << "it only observes";
  }
  EXPECT_NEAR(in_doubles(passivity.energy), 1000.0 / (1 << 20) - 0.5, 1e-6);
}

/// Ends of all ranges, and the lower limit of the energy. In the checked build an overflow stops it.
TEST(TouchPassivity, SurvivesTheEndsOfItsRanges) {
  Random random(332);
  PassivityRules rules = generous();
  rules.ceiling = 0xffffffffu;
  Passivity passivity = Passivity::at_rest();
  const auto end = [&](double most) {
    return random.below(3) == 0 ? 0.0 : random.below(2) == 0 ? most : -most;
  };
  const auto vector = [&](double most) {
    const double x = end(most);
    const double y = end(most);
    return Vector3d(x, y, end(most));
  };
  for (int i = 0; i < 200000; ++i) {
    if (i % 1000 == 0) passivity.energy = random.below(2) == 0 ? -kEnergyLimit : Energy::from_raw(1);
    const double reach = random.below(2) == 0 ? 8.0 : 2e-5;
    const auto out = keep_passive(rules, fixed_vector<Force>(vector(8.0)),
                                  fixed_vector<Position>(vector(reach)), passivity);
    ASSERT_LE(doubles(out).cwiseAbs().maxCoeff(), 9.0);
    ASSERT_LE(std::abs(in_doubles(passivity.energy)), 1048576.0);
  }
}

}  // namespace
}  // namespace palpate::test
