// What of the body's force reaches the tool.
#include "palpate/touch/reaction.hpp"

#include <gtest/gtest.h>

#include "palpate/touch/grasp.hpp"
#include "support/fixed.hpp"
#include "support/random.hpp"

namespace palpate::test {
namespace {

using Eigen::Vector3d;

ContactRules rules_with(double limit, double slew) {
  ContactRules rules{};
  rules.radius = Position::ratio(1, 8);
  rules.stiffness = Coupling::ratio(1, 1);
  rules.force_limit = sim::to_fixed<Force>(limit);
  rules.slew = sim::to_fixed<Force>(slew);
  rules.passivity = PassivityRules{1u << 20, Coupling::from_raw(0)};  // observes only
  return rules;
}

/// Whatever is asked for, even what a node's force can't be.
TEST(TouchReaction, KeepsItsLimitAndItsSlew) {
  Random random(361);
  const double lsb = sim::to_double(Force::from_raw(1));
  for (int round = 0; round < 50; ++round) {
    const double limit = 0.01 + 0.99 * std::abs(random.vector()[0]);
    const double slew = 0.001 + 0.999 * std::abs(random.vector()[0]);
    const ContactRules rules = rules_with(limit, slew);
    Reaction reaction = Reaction::none();
    Vector3d before = Vector3d::Zero();
    for (int i = 0; i < 200; ++i) {
      const Vector3d asked = (i % 7 == 0 ? 60.0 : 1.0) * random.vector();
      const Vector3d now =
          doubles(react(rules, fixed_vector<Force>(asked), fixed_vector<Position>(random.vector()),
                        random.below(2) == 1, reaction));
      ASSERT_LE(now.norm(), limit + 8 * lsb);
      ASSERT_LE((now - before).norm(), slew + 8 * lsb);
      before = now;
    }
  }
}

TEST(TouchReaction, ArrivesAtWhatIsAskedFor) {
  const ContactRules rules = rules_with(0.5, 0.01);
  Reaction reaction = Reaction::none();
  const Vector3d asked(0.1, -0.2, 0.05);
  Vector3d now;
  for (int i = 0; i < 30; ++i) {
    now = doubles(react(rules, fixed_vector<Force>(asked), zero_vector<Position>(), true, reaction));
  }
  EXPECT_LT((now - asked).norm(), 1e-6);
}

/// What the hand does while there is no tool is no work.
TEST(TouchReaction, CountsNoWorkWithoutATool) {
  const ContactRules rules = rules_with(0.5, 0.5);
  Reaction reaction = Reaction::none();
  const auto force = fixed_vector<Force>(Vector3d(0.3, 0.0, 0.0));
  const auto at = [](double x) { return fixed_vector<Position>(Vector3d(x, 0.0, 0.0)); };
  (void)react(rules, force, at(0.0), true, reaction);
  (void)react(rules, force, at(1.0), false, reaction);
  (void)react(rules, force, at(2.0), true, reaction);
  EXPECT_EQ(reaction.passivity.energy.raw(), 0);
  (void)react(rules, force, at(1.9), true, reaction);
  EXPECT_NEAR(std::ldexp(static_cast<double>(reaction.passivity.energy.raw()), -40), 0.03, 1e-6);
}

/// A debt that the slew leaves is paid by a tool that moves on, and given up by one that is free for a
/// second: from then on nothing brakes it.
TEST(TouchReaction, AFreeToolIsNotBrakedForever) {
  ContactRules rules = rules_with(0.5, 0.01);
  rules.passivity.most_damping = Coupling::max();
  const auto free_run = [&](int ticks_between_steps) {
    Reaction reaction = Reaction::none();
    double x = 0.0;
    const auto tick = [&](double asked) {
      return react(rules, fixed_vector<Force>(Vector3d(asked, 0.0, 0.0)),
                   fixed_vector<Position>(Vector3d(x, 0.0, 0.0)), true, reaction);
    };
    for (int i = 0; i < 20; ++i) tick(0.5);
    x += 0.1;  // with the force: the body gives what it never got
    tick(0.5);
    EXPECT_LT(reaction.passivity.energy.raw(), 0);
    uint32_t braked = 0;
    for (int i = 0; i < 3 * kFreeTicks; ++i) {
      x += i % ticks_between_steps == 0 ? 0.0005 : 0.0;
      tick(0.0);
      braked += reaction.passivity.is_braking ? 1u : 0u;
      if (i > kFreeTicks + 100) {
        EXPECT_EQ(reaction.force, zero_vector<Force>()) << i;
      }
    }
    EXPECT_GE(reaction.passivity.energy.raw(), 0);
    return braked;
  };
  EXPECT_GT(free_run(1), 0u);
  EXPECT_GT(free_run(8), 0u);
}

/// A contact that chatters goes on paying.
TEST(TouchReaction, AShortWayWithoutATouchForgivesNothing) {
  ContactRules rules = rules_with(0.5, 0.01);
  Reaction reaction = Reaction::none();
  reaction.passivity.energy = Energy::from_raw(-1000);
  const auto ask = [&](double force) {
    (void)react(rules, fixed_vector<Force>(Vector3d(force, 0.0, 0.0)), zero_vector<Position>(), true,
                reaction);
  };
  for (int i = 0; i < 10 * kFreeTicks; ++i) ask(i % (kFreeTicks - 1) == 0 ? 0.01 : 0.0);
  EXPECT_EQ(reaction.passivity.energy.raw(), -1000);
  for (int i = 0; i < kFreeTicks; ++i) ask(0.0);
  EXPECT_EQ(reaction.passivity.energy.raw(), 0);
}

/// An eighth of the way in each tick, and all of it in the end.
TEST(TouchGrasp, EasesTheNodeTowardsTheTool) {
  const auto target = fixed_vector<Position>(Vector3d(0.25, -0.5, 0.125));
  Vector3<Position> at = zero_vector<Position>();
  double left = doubles(target).norm();
  for (int i = 0; i < 40; ++i) {
    at = eased(at, target);
    const double now = (doubles(target) - doubles(at)).norm();
    ASSERT_NEAR(now, 7.0 / 8.0 * left, 1e-7);
    left = now;
  }
  for (int i = 0; i < 200; ++i) at = eased(at, target);
  EXPECT_LT((doubles(target) - doubles(at)).norm(), 1e-6);
}

}  // namespace
}  // namespace palpate::test
