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

#ifdef PALPATE_CHECKED
TEST(BoundedDeathTest, CheckedBuildRefusesMoreThanTheMaximum) {
  EXPECT_DEATH(static_cast<void>(visited<3>(4)), "more than its maximum");
}
#else
TEST(Bounded, ClampsToItsMaximum) {
  EXPECT_EQ(visited<3>(4), (std::vector<uint32_t>{0, 1, 2}));
  EXPECT_EQ(visited<3>(0xffffffffu), (std::vector<uint32_t>{0, 1, 2}));
  EXPECT_TRUE(visited<0>(7).empty());
}
#endif

}  // namespace
}  // namespace palpate
