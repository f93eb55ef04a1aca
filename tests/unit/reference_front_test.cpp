// The bisection tree, rotation fronts over it, and the equilibrium with groups, on a coarse bar.
#include "reference/front.hpp"

#include <gtest/gtest.h>

#include <map>

#include "reference/polar_rotation.hpp"
#include "reference/rotation_criterion.hpp"
#include "support/forests.hpp"
#include "support/random.hpp"

namespace palpate::reference {
namespace {

using test::Random;

constexpr double kEdgeM = 0.064;

BisectionTree bar_tree(uint8_t level) {
  const auto forest = test::roots_of<test::Bar>(test::bar_block());
  EXPECT_EQ(refine_uniformly(*forest, level), MeshStatus::kDone);
  return tree_of(*forest, kEdgeM);
}

TEST(BisectionTree, RebuildsEveryTetFromTheLeaves) {
  const BisectionTree tree = bar_tree(6);
  EXPECT_EQ(tree.mesh.tet.size(), 1152u);
  EXPECT_EQ(tree.mesh.rest.size(), 325u);
  EXPECT_EQ(tree.roots.size(), 18u);
  EXPECT_EQ(tree.tet.size(), 2u * 1152u - 18u);
  for (const TreeTet& tet : tree.tet) {
    if (tet.child[0] == kNoTet) continue;
    const uint32_t end = refinement_end(type_of_level(tet.level));
    const auto& rest = tree.mesh.rest;
    const Vector middle = 0.5 * (rest[tet.node[0]] + rest[tet.node[end]]);
    for (const uint32_t child : tet.child) {
      EXPECT_EQ(rest[tree.tet[child].node[end]], middle);
      EXPECT_NEAR(tree.tet[child].volume, tet.volume / 2, 1e-18);
      EXPECT_EQ(tree.tet[child].level, tet.level + 1);
    }
  }
  for (const auto& patch : tree.patches) EXPECT_LE(patch.size(), 8u);
}

/// Area of the faces that belong to one tet only: in a conforming mesh, the surface of the block.
double lone_area(const Front& front) {
  std::map<std::array<uint32_t, 3>, int> count;
  const BisectionTree& tree = front.tree();
  for (const uint32_t t : front.tets()) {
    for (uint32_t face = 0; face < 4; ++face) {
      std::array<uint32_t, 3> nodes{};
      for (uint32_t k = 0; k < 3; ++k) nodes[k] = tree.tet[t].node[(face + 1 + k) % 4];
      std::sort(nodes.begin(), nodes.end());
      ++count[nodes];
    }
  }
  double area = 0.0;
  for (const auto& [nodes, times] : count) {
    const auto& rest = tree.mesh.rest;
    if (times == 1) {
      area += 0.5 * (rest[nodes[1]] - rest[nodes[0]]).cross(rest[nodes[2]] - rest[nodes[0]]).norm();
    }
  }
  return area;
}

TEST(Front, ConformsWhenItsSplitsDo) {
  const BisectionTree tree = bar_tree(6);
  const double surface = 14 * kEdgeM * kEdgeM;
  Random random(81);
  Front front(tree);
  EXPECT_NEAR(lone_area(front), surface, 1e-12);
  for (int i = 0; i < 60; ++i) {
    front.split(front.tets()[random.below(front.count())], Closure::kConforming);
    EXPECT_NEAR(lone_area(front), surface, 1e-12);
    EXPECT_EQ(front.tets().size(), front.count());
  }
  EXPECT_GT(front.count(), 100u);
}

TEST(Front, CoversEveryLeafOnceAndMergesBack) {
  const BisectionTree tree = bar_tree(6);
  Random random(82);
  Front front(tree);
  for (int i = 0; i < 20000; ++i) {
    const uint32_t t = random.below(static_cast<uint32_t>(tree.tet.size()));
    if (front.can_merge(t) && random.below(3) == 0) front.merge(t);
    front.split(t, Closure::kNone);
  }
  EXPECT_EQ(front.tets().size(), front.count());
  uint32_t leaves = 0;
  for (const uint32_t t : front.tets()) leaves += tree.tet[t].end_leaf - tree.tet[t].first_leaf;
  EXPECT_EQ(leaves, 1152u);
  for (auto t = static_cast<uint32_t>(tree.tet.size()); t-- > 0;) {
    if (front.can_merge(t)) front.merge(t);
  }
  EXPECT_EQ(front.tets(), Front(tree).tets());
}

class CoarseBend : public ::testing::Test {
 protected:
  AdaptiveCorotation bent(RotationSource source) {
    return AdaptiveCorotation(
        tree_, bend_problem(tree_.mesh, material_of(500, 0.49, 10), 1.0, BendFrame::kHeldEnd), source);
  }
  BisectionTree tree_ = bar_tree(4);
};

TEST_F(CoarseBend, GroupsOfOneLeafAreFullCorotation) {
  for (const RotationSource source : {RotationSource::kOwnNodes, RotationSource::kMeanGradient}) {
    AdaptiveCorotation body = bent(source);
    ASSERT_TRUE(body.settle(Front(tree_)));
    EXPECT_GT(body.error().mean_mm, 0.1);
    ASSERT_TRUE(body.settle(Front::of_leaves(tree_)));
    EXPECT_LT(body.error().max_mm, 1e-5);
  }
}

TEST_F(CoarseBend, IsInEquilibriumWithItsOwnRotations) {
  AdaptiveCorotation body = bent(RotationSource::kMeanGradient);
  const Front front(tree_);
  ASSERT_TRUE(body.settle(front));
  Vector total = Vector::Zero();
  for (uint32_t node = 0; node < body.force().size(); ++node) {
    total += body.force()[node];
    if (!body.free_nodes().is_free(node)) continue;
    EXPECT_LT(body.force()[node].norm(), 1e-8);
  }
  EXPECT_LT(total.norm(), 1e-12);
  for (const uint32_t group : front.tets()) {
    Matrix mean = Matrix::Zero();
    for (uint32_t i = tree_.tet[group].first_leaf; i < tree_.tet[group].end_leaf; ++i) {
      mean += body.leaves()[i].volume * body.gradient(i);
    }
    EXPECT_LT(angle_between(polar_rotation(mean), body.rotation(group)), 1e-9);
  }
}

/// The halves' means explain a part of the whole; what is left is what the children have.
TEST_F(CoarseBend, RemainingRotationIsAVariance) {
  AdaptiveCorotation body = bent(RotationSource::kMeanGradient);
  const Front front(tree_);
  ASSERT_TRUE(body.settle(front));
  for (const uint32_t group : front.tets()) {
    const RemainingRotation sums = remaining_rotation(body, group);
    EXPECT_GE(sums.first, 0.0);
    EXPECT_GT(sums.all, 0.0);
    EXPECT_LE(sums.first + sums.second, sums.all * (1 + 1e-12));
  }
}

TEST_F(CoarseBend, MergedMeasureIsPredictedFromTheChildren) {
  AdaptiveCorotation body = bent(RotationSource::kMeanGradient);
  Front front(tree_);
  for (const uint32_t root : tree_.roots) front.split(root, Closure::kNone);
  ASSERT_TRUE(body.settle(front));
  double predicted = 0.0;
  for (const uint32_t root : tree_.roots) predicted += remaining_rotation_merged(body, root).measure();
  ASSERT_TRUE(body.settle(Front(tree_)));
  double actual = 0.0;
  for (const uint32_t root : tree_.roots) actual += remaining_rotation(body, root).measure();
  EXPECT_NEAR(predicted, actual, 0.1 * actual);
}

TEST_F(CoarseBend, AThresholdStopsBothWaysNearTheSameFront) {
  AdaptiveCorotation body = bent(RotationSource::kMeanGradient);
  const double threshold = 1e-3 * tree_.tet[tree_.roots[0]].volume;
  Front up(tree_);
  ASSERT_TRUE(adapt(body, up, threshold, 0.0));
  Front down = Front::of_leaves(tree_);
  ASSERT_TRUE(adapt(body, down, threshold, 0.5 * threshold));
  EXPECT_GT(up.count(), 18u);
  EXPECT_LT(down.count(), tree_.mesh.tet.size());
  EXPECT_GE(down.count(), up.count());
  EXPECT_LT(down.count(), 2 * up.count());
}

}  // namespace
}  // namespace palpate::reference
