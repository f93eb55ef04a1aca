#include "telemetry/ring_threads.hpp"

#include <gtest/gtest.h>

#include "support/soak.hpp"

namespace palpate::test {
namespace {

template <uint32_t Capacity>
void expect_whole_race(uint32_t first) {
  const auto records = in_soak(100000000u, 300000u);
  const RaceResult result = race<Capacity>(records, first);
  EXPECT_EQ(result.taken + result.dropped, records);
  EXPECT_EQ(result.torn, 0u);
  EXPECT_EQ(result.out_of_order, 0u);
  EXPECT_GT(result.taken, 0u);
}

TEST(RingThreads, LoseNothingUncounted) {
  expect_whole_race<2>(0);
  expect_whole_race<64>(0);
}

TEST(RingThreads, PassTheEndOfTheCounters) { expect_whole_race<8>(0u - 1000u); }

}  // namespace
}  // namespace palpate::test
