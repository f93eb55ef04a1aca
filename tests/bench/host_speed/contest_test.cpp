// The statistics of the contest, on work whose time is known.
#include "contest.hpp"

#include <gtest/gtest.h>

namespace palpate::bench {
namespace {

TEST(Contest, AFigureIsAMedianAndItsQuartiles) {
  const Figure figure = figure_of({5.0, 1.0, 4.0, 2.0, 3.0});
  EXPECT_DOUBLE_EQ(figure.median, 3.0);
  EXPECT_DOUBLE_EQ(figure.low, 2.0);
  EXPECT_DOUBLE_EQ(figure.high, 4.0);
  EXPECT_DOUBLE_EQ(figure_of({1.0, 2.0}).median, 1.5);
  EXPECT_DOUBLE_EQ(figure_of({7.0}).low, 7.0);
}

/// One slice that does not count, then one a round, all in turn.
TEST(Contest, EverybodyRunsInTurn) {
  std::string order;
  Contest contest;
  contest.add([&order] { order += 'a'; }, 2);
  contest.add([&order] { order += 'b'; }, 1);
  contest.race(3);
  EXPECT_EQ(order, "aabaabaabaab");
}

/// A hundred times the work is more than ten and less than a thousand times as slow, whatever the machine.
TEST(Contest, MoreWorkIsSlower) {
  const auto work = [](uint32_t steps) {
    return [steps] {
      volatile uint32_t sum = 0;
      for (uint32_t i = 0; i < steps; ++i) sum = sum + i;
    };
  };
  Contest contest;
  const std::size_t light = contest.add(work(10'000), 10);
  const std::size_t heavy = contest.add(work(1'000'000), 10);
  contest.race(5);
  const Figure ratio = contest.speed_ratio(light, heavy);
  EXPECT_GT(ratio.median, 10.0);
  EXPECT_LT(ratio.median, 1000.0);
  EXPECT_LE(ratio.low, ratio.median);
  EXPECT_GE(ratio.high, ratio.median);
  EXPECT_GT(contest.time_us(heavy).median, contest.time_us(light).median);
}

}  // namespace
}  // namespace palpate::bench
