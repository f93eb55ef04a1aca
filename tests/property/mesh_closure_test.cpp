// What one request costs: bisecting a leaf asks for coarser patches first, and their number and the descent
// to them are bounded by its level.
#include <gtest/gtest.h>

#include "support/forests.hpp"
#include "support/random.hpp"
#include "support/soak.hpp"

namespace palpate::test {
namespace {

/// Steps from `wanted` up to a patch that is ready; each must go to a coarser leaf.
uint32_t descent_depth(const Forest<Deep>& forest, uint16_t wanted) {
  Patch patch{};
  uint32_t depth = 0;
  uint16_t at = wanted;
  while (find_patch(forest, at, patch) == MeshStatus::kNotReady) {
    EXPECT_LT(forest.level_of(patch.blocker), forest.level_of(at));
    at = patch.blocker;
    ++depth;
  }
  Patch ready{};
  EXPECT_EQ(find_ready_patch(forest, wanted, ready), MeshStatus::kDone);
  EXPECT_EQ(ready.tet[0], patch.tet[0]);
  return depth;
}

struct Cost {
  uint32_t most_tets[15] = {};
  uint32_t most_patches[15] = {};
  uint32_t deepest[15] = {};
};

/// Bisects leaf `wanted` and books what it took under its level.
bool request(Forest<Deep>& forest, uint16_t wanted, Cost& cost) {
  const uint8_t level = forest.level_of(wanted);
  cost.deepest[level] = std::max(cost.deepest[level], descent_depth(forest, wanted));
  uint32_t tets = 0;
  const uint32_t patches = bisect_with_closure(forest, wanted, &tets);
  cost.most_tets[level] = std::max(cost.most_tets[level], tets);
  cost.most_patches[level] = std::max(cost.most_patches[level], patches);
  return patches != 0;
}

void expect_bounded(const Cost& cost) {
  for (uint32_t level = 0; level < 14; ++level) {
    std::printf("level %2u: at most %3u tets in %3u patches, descent %2u\n", level, cost.most_tets[level],
                cost.most_patches[level], cost.deepest[level]);
    EXPECT_LE(cost.deepest[level], level);
    EXPECT_LE(cost.most_tets[level], 8 + 37 * level);
    EXPECT_LE(cost.most_patches[level], 1 + 8 * level);
  }
}

/// Refines wherever `is_wanted(leaf)` holds until nothing there is coarser than `level`.
template <class IsWanted>
void refine_where(Forest<Deep>& forest, uint8_t level, Cost& cost, IsWanted is_wanted) {
  for (uint32_t i = 0; i < forest.leaf_count;) {
    const Leaf& leaf = forest.leaf[i];
    if (leaf.level() < level && is_wanted(leaf)) {
      ASSERT_TRUE(request(forest, leaf.tet, cost));
      i = 0;
    } else {
      ++i;
    }
  }
}

template <class OnPart>
bool touches(const Forest<Deep>& forest, const Leaf& leaf, OnPart on_part) {
  return std::any_of(leaf.node.begin(), leaf.node.end(),
                     [&](uint16_t n) { return on_part(forest.node.rest[n]); });
}

TEST(MeshClosure, RefinesACornerToTheDeepestLevel) {
  const Block block = bar_block();
  for (const LatticePoint corner : {block.corner(0, 0, 0), block.corner(1, 0, 0), block.corner(1, 1, 3)}) {
    auto forest = roots_of<Deep>(block);
    Cost cost;
    refine_where(*forest, 14, cost, [&](const Leaf& leaf) {
      return touches(*forest, leaf, [&](LatticePoint p) { return p == corner; });
    });
    EXPECT_EQ(check_forest(*forest, block), Violation::kNothing);
    std::printf("%u leaves, %u nodes\n", unsigned{forest->leaf_count}, unsigned{forest->nodes.used()});
    expect_bounded(cost);
  }
}

TEST(MeshClosure, RefinesAnEdgeToLevel12) {
  const Block block = bar_block();
  auto forest = roots_of<Deep>(block);
  Cost cost;
  const LatticePoint corner = block.corner(0, 1, 0);
  refine_where(*forest, 12, cost, [&](const Leaf& leaf) {
    return touches(*forest, leaf, [&](LatticePoint p) { return p.x == corner.x && p.y == corner.y; });
  });
  EXPECT_EQ(check_forest(*forest, block), Violation::kNothing);
  std::printf("%u leaves, %u nodes\n", unsigned{forest->leaf_count}, unsigned{forest->nodes.used()});
  expect_bounded(cost);
}

/// 810 leaves along an edge use 268 nodes: local refinement needs more nodes than as many leaves all over.
TEST(MeshClosure, StaysBoundedAtRandom) {
  const Block block = notched_block();
  Cost cost;
  for (uint64_t seed = 0; seed < in_soak(200u, 6u); ++seed) {
    Random random(seed);
    auto forest = roots_of<Deep>(block);
    // A random walk into the depth: each request is a child or neighbour of the one before.
    for (uint32_t i = 0; i < 400; ++i) {
      const Leaf* leaf = &forest->leaf[random.below(forest->leaf_count)];
      for (int best = 0; best < 6; ++best) {
        const Leaf* other = &forest->leaf[random.below(forest->leaf_count)];
        if (other->level() > leaf->level() && other->level() < 14) leaf = other;
      }
      if (leaf->level() < 14) {
        ASSERT_TRUE(request(*forest, leaf->tet, cost));
      }
    }
    ASSERT_EQ(check_forest(*forest, block), Violation::kNothing);
  }
  expect_bounded(cost);
}

}  // namespace
}  // namespace palpate::test
