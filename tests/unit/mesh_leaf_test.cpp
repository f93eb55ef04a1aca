#include "palpate/mesh/leaf.hpp"

#include <gtest/gtest.h>

namespace palpate::test {
namespace {

void expect_kind(const LeafKind& kind, uint32_t path, Axes axes, uint32_t region, uint32_t level) {
  EXPECT_EQ(kind.path(), path);
  EXPECT_EQ(kind.axes(), axes);
  EXPECT_EQ(kind.region(), region);
  EXPECT_EQ(kind.level(), level);
}

/// None of its parts reaches into another.
TEST(LeafKind, HoldsTheLargestOfEachPart) {
  const Axes none = Axes::of_code(0);
  const Axes all = Axes::of_code(Axes::kMostCode);
  constexpr uint32_t kLongest = (1u << kDeepestLevel) - 1u;
  expect_kind(LeafKind(0, none, 0, 0), 0, none, 0, 0);
  expect_kind(LeafKind(kLongest, none, 0, 0), kLongest, none, 0, 0);
  expect_kind(LeafKind(0, all, 0, 0), 0, all, 0, 0);
  expect_kind(LeafKind(0, none, kRegions - 1, 0), 0, none, kRegions - 1, 0);
  expect_kind(LeafKind(0, none, 0, kDeepestLevel), 0, none, 0, kDeepestLevel);
  expect_kind(LeafKind(kLongest, all, kRegions - 1, kDeepestLevel), kLongest, all, kRegions - 1,
              kDeepestLevel);
}

/// Down along a path of all lengths and back.
TEST(LeafKind, DescendsToChildrenAndBack) {
  for (const uint32_t path : {0x2a5bu, 0x0000u, 0x3fffu, 0x1234u}) {
    Axes axes = Axes::of(1, 2, 0);
    LeafKind kind(0, axes, 5, 0);
    for (uint32_t level = 0; level < kDeepestLevel; ++level) {
      const uint32_t which = (path >> (kDeepestLevel - 1 - level)) & 1u;
      const LeafKind first = kind.child(0).parent();
      expect_kind(first, kind.path(), kind.axes(), kind.region(), kind.level());
      if (which == 1) axes = axes.of_second_child(type_of_level(level));
      kind = kind.child(which);
      expect_kind(kind, path >> (kDeepestLevel - 1 - level), axes, 5, level + 1);
    }
  }
}

}  // namespace
}  // namespace palpate::test
