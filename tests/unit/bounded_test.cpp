#include "palpate/numeric/bounded.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace palpate {
namespace {

template <uint32_t Max>
std::vector<uint32_t> visited(uint32_t count) {
  std::vector<uint32_t> indices;
  for (const uint32_t index : bounded<Max>(count, [] {})) indices.push_back(index);
  return indices;
}

TEST(Bounded, VisitsEachIndexOnceInOrder) {
  EXPECT_EQ(visited<8>(5), (std::vector<uint32_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(visited<3>(3), (std::vector<uint32_t>{0, 1, 2}));
  EXPECT_EQ(visited<1>(1), (std::vector<uint32_t>{0}));
}

TEST(Bounded, RunsNotAtAllForNothing) {
  EXPECT_TRUE(visited<8>(0).empty());
  EXPECT_TRUE(visited<0>(0).empty());
}

TEST(Bounded, NestsAndBreaks) {
  uint32_t bodies = 0;
  for (const uint32_t outer : bounded<4>(4, [] {})) {
    for (const uint32_t inner : bounded<4>(4, [] {})) {
      if (inner > outer) break;
      ++bodies;
    }
  }
  EXPECT_EQ(bodies, 10u);
}

TEST(Bounded, GivesEachPlaceItsOwnIdentity) {
  const auto here = bounded<4>(1, [] {});
  const auto there = bounded<4>(1, [] {});
  EXPECT_FALSE((std::is_same_v<decltype(here), decltype(there)>));
}

template <class Range>
std::vector<uint32_t> visited_in(Range range) {
  std::vector<uint32_t> indices;
  for (const uint32_t index : range) indices.push_back(index);
  return indices;
}

TEST(BoundedTotal, GivesRangesUntilTheTotalIsUsedUp) {
  auto total = bounded_total<7>([] {});
  EXPECT_EQ(total.left(), 7u);
  EXPECT_EQ(visited_in(total.take(10, 3)), (std::vector<uint32_t>{10, 11, 12}));
  EXPECT_EQ(total.left(), 4u);
  EXPECT_TRUE(visited_in(total.take(5, 0)).empty());
  EXPECT_EQ(visited_in(total.take(0, 4)), (std::vector<uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(total.left(), 0u);
  EXPECT_TRUE(visited_in(total.take(3, 0)).empty());
}

TEST(BoundedTotal, GoesThroughElementsByTheirAddresses) {
  auto total = bounded_total<4>([] {});
  const std::array<uint16_t, 5> numbers{9, 8, 7, 6, 5};
  std::vector<uint16_t> visited;
  for (const uint16_t* number : total.take(numbers.data() + 1, 3)) visited.push_back(*number);
  EXPECT_EQ(visited, (std::vector<uint16_t>{8, 7, 6}));
  EXPECT_EQ(total.left(), 1u);
}

TEST(BoundedTotal, CountsWhatIsTakenAndNotWhatIsRun) {
  auto total = bounded_total<4>([] {});
  for (const uint32_t index : total.take(0, 3)) {
    if (index == 0) break;
  }
  EXPECT_EQ(total.left(), 1u);
}

#ifdef PALPATE_CHECKED
TEST(BoundedDeathTest, CheckedBuildRefusesMoreThanTheTotal) {
  auto total = bounded_total<3>([] {});
  EXPECT_DEATH(static_cast<void>(total.take(0, 4)), "more than their total");
}

TEST(BoundedDeathTest, CheckedBuildRefusesMoreThanTheMaximum) {
  EXPECT_DEATH(static_cast<void>(visited<3>(4)), "more than its maximum");
}
#else
TEST(BoundedTotal, CutsTheRangeAtTheTotal) {
  auto total = bounded_total<5>([] {});
  EXPECT_EQ(visited_in(total.take(0, 4)).size(), 4u);
  EXPECT_EQ(visited_in(total.take(20, 4)), (std::vector<uint32_t>{20}));
  EXPECT_TRUE(visited_in(total.take(0, 0xffffffffu)).empty());
}

TEST(Bounded, ClampsToItsMaximum) {
  EXPECT_EQ(visited<3>(4), (std::vector<uint32_t>{0, 1, 2}));
  EXPECT_EQ(visited<3>(0xffffffffu), (std::vector<uint32_t>{0, 1, 2}));
  EXPECT_TRUE(visited<0>(7).empty());
}
#endif

}  // namespace
}  // namespace palpate
