// Max force, force impulse and max velocity, at their limits and one LSB beyond.
#include "palpate/safety/force_monitor.hpp"

#include <gtest/gtest.h>

#include "every.hpp"
#include "palpate/safety/velocity_monitor.hpp"
#include "support/random.hpp"

namespace palpate::safety {
namespace {

using phantom::Metre;
using phantom::Newton;
using test::just_above;
using test::just_below;
using test::kMotionLimits;
using Random = palpate::test::Random;

constexpr ForceLimits kForceLimits{};

template <class Scalar>
Vector3<Scalar> along(Eigen::Index axis, Scalar value) {
  Vector3<Scalar> v = zero_vector<Scalar>();
  v[axis] = value;
  return v;
}

ConditionSet watch(ForceMonitor& monitor, const Force3& force) {
  return watch_force(monitor, kForceLimits, force);
}
ConditionSet first_force(const Force3& force) {
  ForceMonitor monitor = make_force_monitor();
  return watch(monitor, force);
}

TEST(MaxForce, IsAboveTheLimitByOneLsbOnAnyAxis) {
  for (const Eigen::Index axis : {0, 1, 2}) {
    for (const Newton limit : {kForceLimits.max_newtons}) {
      EXPECT_TRUE(first_force(along(axis, just_below(limit))).is_empty());
      EXPECT_TRUE(first_force(along(axis, limit)).is_empty());
      EXPECT_TRUE(first_force(along(axis, -limit)).is_empty());
      EXPECT_TRUE(first_force(along(axis, just_above(limit))).has(Condition::kMaxForce));
      EXPECT_TRUE(first_force(along(axis, -just_above(limit))).has(Condition::kMaxForce));
    }
  }
}

TEST(MaxForce, IsOfTheVectorAtAnyForce) {
  Random random(11);
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector3d newtons = random.direction() * 8.5 * (1 + 1e-6 * random.centred());
    const auto component = [&](Eigen::Index axis) {
      return Newton::from_raw(static_cast<int32_t>(std::lround(std::ldexp(newtons[axis], 27))));
    };
    const Force3 force(component(0), component(1), component(2));
    const Eigen::Vector3d rounded(force[0].raw(), force[1].raw(), force[2].raw());
    const double beyond = std::ldexp(rounded.norm(), -27) - 8.5;
    if (std::abs(beyond) < 1e-8) continue;
    ASSERT_EQ(first_force(force).has(Condition::kMaxForce), beyond > 0);
  }
  const Newton lowest = Newton::min();
  EXPECT_TRUE(first_force({lowest, lowest, lowest}).has(Condition::kMaxForce));
  EXPECT_TRUE(first_force({Newton::max(), lowest, Newton::max()}).has(Condition::kMaxForce));
}

TEST(ForceImpulse, IsAChangeInOneTickAboveTheLimitByOneLsb) {
  const Newton limit = kForceLimits.impulse_newtons_per_tick;
  const Newton start = Newton::ratio(3, 1);
  for (const Newton change : {just_below(limit), limit, just_above(limit)}) {
    for (const bool is_rise : {true, false}) {
      ForceMonitor monitor = make_force_monitor();
      EXPECT_TRUE(watch(monitor, along(1, start)).is_empty());
      const ConditionSet raised = watch(monitor, along(1, is_rise ? start + change : start - change));
      EXPECT_EQ(raised.has(Condition::kForceImpulse), change > limit);
    }
  }
}

TEST(ForceImpulse, LastsForTheTicksInWhoseWindowItIs) {
  // A single step within the window's limit is seen once; both thresholds are crossed by a step of 7 N.
  for (const auto& [newtons, ticks] : {std::pair{2, 1}, std::pair{7, 8}}) {
    ForceMonitor monitor = make_force_monitor();
    EXPECT_TRUE(watch(monitor, along(0, Newton::from_raw(0))).is_empty());
    int raised = 0;
    for (int i = 0; i < 30; ++i) {
      const bool is_raised =
          watch(monitor, along(0, Newton::ratio(newtons, 1))).has(Condition::kForceImpulse);
      EXPECT_EQ(is_raised, i < ticks) << i;
      raised += is_raised ? 1 : 0;
    }
    EXPECT_EQ(raised, ticks);
  }
}

TEST(ForceImpulse, IsAChangeOverTheWindowAboveTheLimitByOneLsb) {
  const Newton limit = kForceLimits.impulse_newtons_per_window;
  for (const Newton total : {just_below(limit), limit, just_above(limit)}) {
    ForceMonitor monitor = make_force_monitor();
    EXPECT_TRUE(watch(monitor, along(2, Newton::from_raw(0))).is_empty());
    for (int32_t i = 1; i <= 7; ++i) {
      const auto part = Newton::from_raw(static_cast<int32_t>(int64_t{total.raw()} * i / 8));
      ASSERT_TRUE(watch(monitor, along(2, part)).is_empty());
    }
    EXPECT_EQ(watch(monitor, along(2, total)).has(Condition::kForceImpulse), total > limit);
  }
}

TEST(ForceImpulse, LetsAnySlowForcePass) {
  ForceMonitor monitor = make_force_monitor();
  for (int i = 0; i <= 8000; ++i) {
    ASSERT_TRUE(watch(monitor, along(0, Newton::ratio(i, 1000))).is_empty()) << i;
  }
}

TEST(ForceImpulse, OfTheWholeRangeIsSeen) {
  ForceMonitor monitor = make_force_monitor();
  (void)watch(monitor, {Newton::min(), Newton::min(), Newton::min()});
  EXPECT_TRUE(watch(monitor, {Newton::max(), Newton::max(), Newton::max()}).has(Condition::kForceImpulse));
}

TEST(MaxVelocity, IsAMotionInOneTickAboveTheLimitByOneLsb) {
  const Metre limit = kMotionLimits.max_metres_per_tick;
  for (const Eigen::Index axis : {0, 1, 2}) {
    for (const Metre way : {just_below(limit), limit, just_above(limit)}) {
      VelocityMonitor monitor = make_velocity_monitor();
      const auto at = [&](Metre metres) {
        return watch_velocity(monitor, kMotionLimits, along(axis, metres)).has(Condition::kMaxVelocity);
      };
      EXPECT_FALSE(at(Metre::ratio(1, 10)));
      EXPECT_EQ(at(Metre::ratio(1, 10) + way), way > limit);
      EXPECT_FALSE(at(Metre::ratio(1, 10) + way));  // stands: cleared
      EXPECT_EQ(at(Metre::ratio(1, 10)), way > limit);
    }
  }
}

TEST(MaxVelocity, IsOfTheVectorAndOfTheWholeRange) {
  VelocityMonitor monitor = make_velocity_monitor();
  const Metre each = Metre::ratio(116, 100000);  // sqrt 3 x 1.16 mm = 2.009 mm
  EXPECT_TRUE(watch_velocity(monitor, kMotionLimits, zero_vector<Metre>()).is_empty());
  EXPECT_FALSE(watch_velocity(monitor, kMotionLimits, {each, each, each}).is_empty());
  EXPECT_FALSE(watch_velocity(monitor, kMotionLimits, {Metre::min(), Metre::min(), Metre::min()}).is_empty());
  EXPECT_FALSE(watch_velocity(monitor, kMotionLimits, {Metre::max(), Metre::max(), Metre::max()}).is_empty());
}

}  // namespace
}  // namespace palpate::safety
