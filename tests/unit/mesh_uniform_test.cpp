#include <gtest/gtest.h>

#include <map>
#include <set>

#include "palpate/mesh/rotation_front.hpp"
#include "support/forests.hpp"

namespace palpate::test {
namespace {

struct Counts {
  uint8_t level;
  uint16_t leaves, nodes;
};

TEST(UniformMesh, OfTheBarHasThePapersCounts) {
  auto forest = roots_of<Bar>(bar_block());
  for (const Counts counts : {Counts{0, 18, 16}, Counts{3, 144, 63}, Counts{6, 1152, 325}}) {
    ASSERT_EQ(refine_uniformly(*forest, counts.level), MeshStatus::kDone);
    EXPECT_EQ(forest->leaf_count, counts.leaves);
    EXPECT_EQ(forest->nodes.used(), counts.nodes);
    EXPECT_EQ(check_forest(*forest, bar_block()), Violation::kNothing);
    for (uint32_t i = 0; i < forest->leaf_count; ++i) {
      EXPECT_EQ(forest->leaf[i].level(), counts.level);
      EXPECT_EQ(type_of_level(forest->leaf[i].level()), TetType::kType0);
    }
  }
}

TEST(UniformMesh, ConformsAtEveryLevelOfEveryBlock) {
  std::array<uint16_t, kRegions> density = kOneDensity;
  density[1] = 777;
  for (const Block& block : {full_block(1, 1, 1), full_block(2, 2, 1), notched_block()}) {
    auto forest = roots_of<Deep>(block, density);
    for (uint8_t level = 0; level <= 9; ++level) {
      ASSERT_EQ(refine_uniformly(*forest, level), MeshStatus::kDone);
      ASSERT_EQ(check_forest(*forest, block), Violation::kNothing) << unsigned{level};
    }
  }
}

/// Uniform meshes fill a root's lattice at every third level; others have a part of it.
TEST(UniformMesh, ARootHasNoMoreNodesThanItsLattice) {
  auto forest = roots_of<Deep>(full_block(1, 1, 1));
  for (uint8_t level = 0; level <= 9; ++level) {
    ASSERT_EQ(refine_uniformly(*forest, level), MeshStatus::kDone);
    std::map<uint16_t, std::set<uint16_t>> nodes_of_root;
    for (uint32_t i = 0; i < forest->leaf_count; ++i) {
      std::set<uint16_t>& nodes = nodes_of_root[ancestor_at(*forest, forest->leaf[i].tet, 0)];
      nodes.insert(forest->leaf[i].node.begin(), forest->leaf[i].node.end());
    }
    ASSERT_EQ(nodes_of_root.size(), kRootsPerCube);
    for (const auto& [root, nodes] : nodes_of_root) {
      EXPECT_LE(nodes.size(), most_nodes_of_root(level));
      EXPECT_EQ(nodes.size() == most_nodes_of_root(level), level % 3 == 0) << unsigned{level};
    }
  }
}

TEST(UniformMesh, LargestBlockReachesLevel3) {
  const Block block = full_block(4, 4, 4);
  auto forest = roots_of<Deep>(block);
  ASSERT_NE(forest, nullptr);
  EXPECT_EQ(forest->leaf_count, 384);
  EXPECT_EQ(forest->nodes.used(), 125);
  ASSERT_EQ(refine_uniformly(*forest, 3), MeshStatus::kDone);
  EXPECT_EQ(check_forest(*forest, block), Violation::kNothing);
  EXPECT_EQ(forest->nodes.used(), 729);
}

TEST(UniformMesh, MergesBackToItsRoots) {
  for (const Block& block : {bar_block(), notched_block()}) {
    auto forest = roots_of<TestProfile<8000, 3000, 9>>(block);
    const Content roots = content_of(*forest);
    ASSERT_EQ(refine_uniformly(*forest, 7), MeshStatus::kDone);
    EXPECT_GT(merge_all(*forest), 0u);
    EXPECT_TRUE(content_of(*forest) == roots);
    EXPECT_EQ(check_forest(*forest, block), Violation::kNothing);
    EXPECT_EQ(forest->leaf_counters.refused, 0);
    EXPECT_EQ(forest->nodes.counters().refused, 0);
  }
}

TEST(UniformMesh, EndsAtTheProfilesDeepestLevel) {
  auto forest = roots_of<TestProfile<1152, 512, 4>>(bar_block());
  ASSERT_EQ(refine_uniformly(*forest, 4), MeshStatus::kDone);
  Patch patch{};
  EXPECT_EQ(find_patch(*forest, forest->leaf[0].tet, patch), MeshStatus::kLevelLimit);
  EXPECT_EQ(find_ready_patch(*forest, forest->leaf[0].tet, patch), MeshStatus::kLevelLimit);
}

TEST(UniformMesh, RootsDoNotMerge) {
  const auto forest = roots_of<Bar>(bar_block());
  for (uint32_t i = 0; i < forest->leaf_count; ++i) {
    Patch patch{};
    EXPECT_EQ(find_merge(*forest, forest->leaf[i].tet, patch), MeshStatus::kNotMergeable);
  }
}

/// Mirrored and translated cubes are the same mesh from level 2 on, so a body has the symmetries of its
/// block.
TEST(UniformMesh, HasTheSymmetriesOfTheBlockFromLevel2On) {
  const auto mirrored_content = [](const Forest<Bar>& forest, int sx, int sy, int sz, bool swap) {
    std::set<std::set<Point>> tets;
    for (uint32_t i = 0; i < forest.leaf_count; ++i) {
      std::set<Point> corners;
      for (const uint16_t node : forest.leaf[i].node) {
        const LatticePoint p = forest.node.rest[node];
        corners.insert(swap ? Point(sx * p.y, sy * p.x, sz * p.z) : Point(sx * p.x, sy * p.y, sz * p.z));
      }
      tets.insert(corners);
    }
    return tets;
  };
  auto forest = roots_of<Bar>(bar_block());
  for (uint8_t level = 0; level <= 6; ++level) {
    ASSERT_EQ(refine_uniformly(*forest, level), MeshStatus::kDone);
    const auto itself = mirrored_content(*forest, 1, 1, 1, false);
    EXPECT_TRUE(mirrored_content(*forest, 1, 1, 1, true) == itself) << "swap, level " << unsigned{level};
    EXPECT_TRUE(mirrored_content(*forest, -1, -1, -1, false) == itself) << "point, level " << unsigned{level};
    if (level < 2) continue;
    EXPECT_TRUE(mirrored_content(*forest, -1, 1, 1, false) == itself) << "x, level " << unsigned{level};
    EXPECT_TRUE(mirrored_content(*forest, 1, -1, 1, false) == itself) << "y, level " << unsigned{level};
    EXPECT_TRUE(mirrored_content(*forest, 1, 1, -1, false) == itself) << "z, level " << unsigned{level};
  }
}

}  // namespace
}  // namespace palpate::test
