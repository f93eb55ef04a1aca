// What re-meshing ranks by: stretches of edges, and the worst within a budget.
#include <gtest/gtest.h>

#include "palpate/remesh/stretch.hpp"
#include "palpate/remesh/worst_first.hpp"
#include "support/fixed.hpp"
#include "support/random.hpp"

namespace palpate::test {
namespace {

constexpr double kLsb = 1.0 / (1 << 27);

/// (l / l0)^2 - 1 within 0 .. 15, l0^2 = quarters / 4 h^2.
double exact_stretch(const Eigen::Vector3d& edge, uint32_t size, int quarters) {
  const double h = 1.0 / (1 << size);
  const double stretch = edge.squaredNorm() / (0.25 * quarters * h * h) - 1.0;
  return std::clamp(stretch, 0.0, 15.0);
}

TEST(EdgeStretch, IsItsFormulaWhateverTheLength) {
  Random random(7);
  NodeState<2> node{};
  uint32_t saturated = 0;
  uint32_t shorter = 0;
  for (int i = 0; i < 20000; ++i) {
    const uint32_t size = random.below(5);
    const std::array<int, 6> all_quarters = {1, 2, 3, 4, 8, 12};
    const int quarters = all_quarters[random.below(6)];
    const double reach = std::ldexp(4.0, -static_cast<int>(random.below(12)));
    for (uint16_t which = 0; which < 2; ++which) {
      const Eigen::Vector3d x = reach * random.vector();
      node.position[which] = within_position_limit(fixed_vector<Position>(x));
    }
    const Eigen::Vector3d edge = doubles(node.position[0]) - doubles(node.position[1]);
    const double exact = exact_stretch(edge, size, quarters);
    const StretchMeasure stretch = edge_stretch(node, 0, 1, size, stretch_detail::of_quarters(quarters));
    ASSERT_NEAR(stretch.raw() * kLsb, exact, 16 * kLsb) << edge.norm() << " long, size " << size;
    saturated += exact == 15.0 ? 1u : 0u;
    shorter += stretch.raw() == 0 ? 1u : 0u;
  }
  EXPECT_GT(saturated, 100u);
  EXPECT_GT(shorter, 100u);
}

TEST(ShiftedDown, RoundsToNearestAndSaturates) {
  using stretch_detail::shifted_down;
  EXPECT_EQ(shifted_down(3, 1), 2u);
  EXPECT_EQ(shifted_down(5, 2), 1u);
  EXPECT_EQ(shifted_down(uint64_t{0x7fffffff} << 19, 19), 0x7fffffffu);
  EXPECT_EQ(shifted_down((uint64_t{0x7fffffff} << 19) + (1u << 18), 19), 0x7fffffffu);
  EXPECT_EQ(shifted_down(uint64_t{0x80000000} << 19, 19), 0x7fffffffu);
  EXPECT_EQ(shifted_down(uint64_t{3} << 60, 29), 0x7fffffffu);
  for (uint32_t shift = 1; shift <= 31; ++shift)
    EXPECT_EQ(shifted_down(uint64_t{12345} << shift, shift), 12345u);
}

TEST(WorstFirst, ClassesRiseTwiceAnOctave) {
  EXPECT_EQ(class_of(0), class_of(1));
  for (const uint32_t measure : {2u, 3u, 4u, 6u, 1000u, 1u << 20, 3u << 30}) {
    EXPECT_GE(class_of(measure), class_of(measure - 1));
    if (measure < 1u << 31) {
      EXPECT_EQ(class_of(2 * measure), class_of(measure) + 2);
    }
  }
  EXPECT_LT(class_of(0xffffffff), kClasses);
  EXPECT_EQ(rank_of(0xffffffff, false), kUnwanted);
  EXPECT_GT(rank_of(0, true), kUnwanted);
}

TEST(WorstFirst, TheLowestRankIsTheOneThatTheBudgetEndsIn) {
  RankCounts ranks;
  for (const int rank : {9, 7, 7, 7, 4, 4, 0, 0}) ranks.add(static_cast<Rank>(rank));
  EXPECT_EQ(ranks.total(), 6u);
  const auto expect = [&](uint32_t budget, uint32_t rank, uint32_t room) {
    const RankCounts::Lowest lowest = ranks.lowest_within(budget);
    EXPECT_EQ(lowest.rank, rank) << budget;
    EXPECT_EQ(lowest.room, room) << budget;
  };
  expect(0, 9, 0);
  expect(1, 9, 1);
  expect(2, 7, 1);
  expect(4, 7, 3);
  expect(5, 4, 1);
  expect(100, 1, 94);
}

}  // namespace
}  // namespace palpate::test
