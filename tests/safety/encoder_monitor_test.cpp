// Encoder range, jump and stuck, at their limits and one count, LSB or tick beyond.
#include "palpate/safety/encoder_monitor.hpp"

#include <gtest/gtest.h>

#include "every.hpp"

namespace palpate::safety {
namespace {

using phantom::Counts;
using test::just_above;
using test::kMotionLimits;
using Currents = std::array<Ampere, 3>;

constexpr Currents kNoCurrents{Ampere::from_raw(0), Ampere::from_raw(0), Ampere::from_raw(0)};

Counts counts_of(std::size_t joint, int32_t counts) {
  Counts all{};
  all[joint] = counts;
  return all;
}
Currents currents_of(std::size_t joint, Ampere current) {
  Currents all = kNoCurrents;
  all[joint] = current;
  return all;
}

ConditionSet watch(EncoderMonitor& monitor, const Counts& counts, bool is_new = true,
                   const Currents& currents = kNoCurrents) {
  return watch_encoders(monitor, kMotionLimits, counts, is_new, currents);
}

TEST(EncoderRange, IsSixteenBits) {
  for (std::size_t joint = 0; joint < 3; ++joint) {
    for (const int32_t inside : {-32768, 0, 32767}) {
      EncoderMonitor monitor = make_encoder_monitor();
      EXPECT_TRUE(watch(monitor, counts_of(joint, inside)).is_empty());
    }
    for (const int32_t outside : {-32769, 32768, INT32_MIN, INT32_MAX}) {
      EncoderMonitor monitor = make_encoder_monitor();
      EXPECT_EQ(watch(monitor, counts_of(joint, outside)), ConditionSet::of(Condition::kEncoderRange));
      EXPECT_FALSE(watch(monitor, counts_of(joint, 0)).has(Condition::kEncoderRange));
    }
  }
}

TEST(EncoderJump, IsOneCountMoreThanTheFastestHand) {
  const int32_t limit = kMotionLimits.max_counts_per_tick;
  for (std::size_t joint = 0; joint < 3; ++joint) {
    for (const int32_t sign : {1, -1}) {
      EncoderMonitor monitor = make_encoder_monitor();
      EXPECT_TRUE(watch(monitor, counts_of(joint, 5000)).is_empty());  // the first one jumps from nowhere
      EXPECT_TRUE(watch(monitor, counts_of(joint, 5000 + sign * limit)).is_empty());
      EXPECT_EQ(watch(monitor, counts_of(joint, 5000 - sign)), ConditionSet::of(Condition::kEncoderJump));
      EXPECT_TRUE(watch(monitor, counts_of(joint, 5000)).is_empty());  // over with the next tick
    }
  }
}

TEST(EncoderJump, IsSeenOverTheWholeRangeOfCounts) {
  EncoderMonitor monitor = make_encoder_monitor();
  (void)watch(monitor, {INT32_MIN, 0, 0});
  EXPECT_TRUE(watch(monitor, {INT32_MAX, 0, 0}).has(Condition::kEncoderJump));
}

TEST(EncoderJump, AllowsTheWayOfEveryMissingMessage) {
  const int32_t limit = kMotionLimits.max_counts_per_tick;
  for (const int32_t missing : {0, 1, 2, 5}) {
    for (const int32_t beyond : {0, 1}) {
      EncoderMonitor monitor = make_encoder_monitor();
      EXPECT_TRUE(watch(monitor, {}).is_empty());
      for (int32_t i = 0; i < missing; ++i) EXPECT_TRUE(watch(monitor, {}, false).is_empty());
      const ConditionSet raised = watch(monitor, counts_of(2, limit * (missing + 1) + beyond));
      EXPECT_EQ(raised.has(Condition::kEncoderJump), beyond > 0);
      EXPECT_TRUE(watch(monitor, counts_of(2, limit * (missing + 2) + beyond)).is_empty());
    }
  }
}

/// Ticks until stuck with this current and a count that stands, or 0.
int ticks_until_stuck(std::size_t joint, Ampere current, int at_most) {
  EncoderMonitor monitor = make_encoder_monitor();
  (void)watch(monitor, {});
  for (int tick = 1; tick <= at_most; ++tick) {
    if (watch(monitor, {}, true, currents_of(joint, current)).has(Condition::kEncoderStuck)) return tick;
  }
  return 0;
}

TEST(EncoderStuck, NeedsMoreThanFrictionForTheWholeTime) {
  for (std::size_t joint = 0; joint < 3; ++joint) {
    EXPECT_EQ(ticks_until_stuck(joint, kMotionLimits.moving_amperes, 3000), 0);
    EXPECT_EQ(ticks_until_stuck(joint, -kMotionLimits.moving_amperes, 3000), 0);
    EXPECT_EQ(ticks_until_stuck(joint, just_above(kMotionLimits.moving_amperes), 3000),
              kMotionLimits.stuck_ticks);
    EXPECT_EQ(ticks_until_stuck(joint, -just_above(kMotionLimits.moving_amperes), 3000),
              kMotionLimits.stuck_ticks);
    EXPECT_EQ(ticks_until_stuck(joint, Ampere::min(), 3000), kMotionLimits.stuck_ticks);
  }
}

TEST(EncoderStuck, ClearsWithACountOrWithLessCurrent) {
  const Currents pulls = currents_of(1, Ampere::ratio(1, 1));
  for (const bool by_motion : {true, false}) {
    EncoderMonitor monitor = make_encoder_monitor();
    for (int i = 0; i < 5000; ++i) (void)watch(monitor, {}, true, pulls);
    EXPECT_TRUE(watch(monitor, {}, true, pulls).has(Condition::kEncoderStuck));
    const ConditionSet after =
        by_motion ? watch(monitor, counts_of(1, 1), true, pulls) : watch(monitor, {}, true, kNoCurrents);
    EXPECT_TRUE(after.is_empty());
    for (uint32_t i = 1; i < kMotionLimits.stuck_ticks; ++i) {  // the count begins anew
      const Counts there = by_motion ? counts_of(1, 1) : Counts{};
      ASSERT_TRUE(watch(monitor, there, true, pulls).is_empty());
    }
  }
}

TEST(EncoderStuck, IsNotAJointThatMovesEvenByACountNowAndThen) {
  EncoderMonitor monitor = make_encoder_monitor();
  for (int i = 0; i < 20000; ++i) {
    const Counts counts = counts_of(0, i / (kMotionLimits.stuck_ticks - 1) % 2);
    ASSERT_TRUE(watch(monitor, counts, true, currents_of(0, Ampere::ratio(5, 1))).is_empty()) << i;
  }
}

TEST(EncoderStuck, IsNotTheOtherJointsMotion) {
  EncoderMonitor monitor = make_encoder_monitor();
  bool is_stuck = false;
  for (int i = 0; i < 1500; ++i) {
    is_stuck =
        watch(monitor, {i, 0, i}, true, currents_of(1, Ampere::ratio(1, 1))).has(Condition::kEncoderStuck);
  }
  EXPECT_TRUE(is_stuck);
}

}  // namespace
}  // namespace palpate::safety
