// Communication lost, cycle slip and tick overrun, to the tick.
#include "palpate/safety/timing_monitor.hpp"

#include <gtest/gtest.h>

namespace palpate::safety {
namespace {

constexpr TimingLimits kTimingLimits{};

class Clock {
 public:
  explicit Clock(uint32_t start = 100) : tick_(start), message_(start) {}

  TimingFindings tick(bool has_message = true, bool is_late = false, uint32_t ticks = 1) {
    tick_ += ticks;
    if (has_message) ++message_;
    return watch_timing(monitor_, kTimingLimits, {tick_, message_, is_late});
  }

 private:
  TimingMonitor monitor_ = make_timing_monitor();
  uint32_t tick_;
  uint32_t message_;
};

TEST(CommunicationLost, IsRaisedInTheLastOfTheSilentTicksAndClearsWithAMessage) {
  for (uint32_t silent = 0; silent < 3u * kTimingLimits.silent_ticks; ++silent) {
    Clock clock;
    EXPECT_TRUE(clock.tick().is_new_message);
    for (uint32_t i = 1; i <= silent; ++i) {
      const TimingFindings found = clock.tick(false);
      EXPECT_FALSE(found.is_new_message);
      EXPECT_EQ(found.conditions.has(Condition::kCommunicationLost), i >= kTimingLimits.silent_ticks);
    }
    const TimingFindings found = clock.tick();
    EXPECT_TRUE(found.is_new_message);
    EXPECT_TRUE(found.conditions.is_empty());
  }
}

TEST(CommunicationLost, CountsTicksInARowOnly) {
  Clock clock;
  for (int i = 0; i < 100; ++i)
    EXPECT_TRUE(clock.tick(i % kTimingLimits.silent_ticks == 0).conditions.is_empty());
}

TEST(CycleSlip, IsAnyNumberButTheSuccessor) {
  for (const uint32_t ticks : {2u, 3u, 0u, 0xffffffffu, 0x80000001u}) {
    Clock clock;
    EXPECT_TRUE(clock.tick().conditions.is_empty());
    EXPECT_TRUE(clock.tick().conditions.is_empty());
    EXPECT_EQ(clock.tick(true, false, ticks).conditions, ConditionSet::of(Condition::kCycleSlip));
    EXPECT_TRUE(clock.tick().conditions.is_empty());
  }
}

TEST(CycleSlip, IsNotTheEndOfTheNumbers) {
  Clock clock(0xfffffff0u);
  for (int i = 0; i < 40; ++i) EXPECT_TRUE(clock.tick().conditions.is_empty());
}

TEST(TickOverrun, IsRaisedByTheLastOfLateCyclesInARowAndClearsWithOneInTime) {
  Clock clock;
  for (int repeat = 0; repeat < 3; ++repeat) {
    for (uint32_t i = 1; i <= 3u * kTimingLimits.overrun_ticks; ++i) {
      EXPECT_EQ(clock.tick(true, true).conditions.has(Condition::kTickOverrun),
                i >= kTimingLimits.overrun_ticks);
    }
    EXPECT_TRUE(clock.tick().conditions.is_empty());
  }
  for (int i = 0; i < 100; ++i) {
    EXPECT_TRUE(clock.tick(true, i % kTimingLimits.overrun_ticks != 0).conditions.is_empty());
  }
}

}  // namespace
}  // namespace palpate::safety
