// How many rotations are enough: the paper's 90 degree bend with groups, against full corotation. The paper's
// table is the gate, an independent computation's figures check the setup.
#include <gtest/gtest.h>

#include "oracle/paper_bar.hpp"
#include "reference/front_search.hpp"
#include "reference/rotation_criterion.hpp"
#include "support/forests.hpp"

namespace palpate::test {
namespace {

using reference::AdaptiveCorotation;
using reference::BisectionTree;
using reference::Closure;
using reference::Criterion;
using reference::Front;
using reference::FrontPoint;
using reference::RotationSource;

const BisectionTree& bar_tree() {
  static const BisectionTree tree = [] {
    const auto forest = roots_of<Bar>(bar_block());
    EXPECT_EQ(refine_uniformly(*forest, 6), MeshStatus::kDone);
    return reference::tree_of(*forest, kEdgeM);
  }();
  return tree;
}

AdaptiveCorotation bent(RotationSource source) {
  return AdaptiveCorotation(
      bar_tree(),
      reference::bend_problem(bar_tree().mesh, tissue(), kQuarterTurn, reference::BendFrame::kHeldEnd),
      source);
}

TEST(RotationFront, OfTheRoots) {
  AdaptiveCorotation own = bent(RotationSource::kOwnNodes);
  ASSERT_TRUE(own.settle(Front(bar_tree())));
  EXPECT_NEAR(own.error().mean_mm, 0.856, 0.001);
  EXPECT_NEAR(own.error().max_mm, 2.02, 0.01);
  AdaptiveCorotation mean = bent(RotationSource::kMeanGradient);
  ASSERT_TRUE(mean.settle(Front(bar_tree())));
  EXPECT_NEAR(mean.error().mean_mm, 0.637, 0.001);
  EXPECT_NEAR(mean.error().max_mm, 1.704, 0.01);
}

/// Face neighbours above |R - R'|_F^2 = 4 (1 - cos 8.1 deg), the paper's criterion to the letter.
TEST(RotationFront, OfFaceNeighbours) {
  AdaptiveCorotation body = bent(RotationSource::kOwnNodes);
  Front front(bar_tree());
  const double f_max = 4.0 * (1.0 - std::cos(8.1 * kQuarterTurn / 90.0));
  ASSERT_TRUE(refine_above(body, front, Criterion::kNeighbours, Closure::kNone, f_max));
  EXPECT_EQ(front.count(), 584u);
  EXPECT_NEAR(body.error().mean_mm, 0.125, 0.001);
  EXPECT_NEAR(body.error().max_mm, 0.332, 0.001);
}

struct PaperRow {
  uint32_t rotation_tets;
  double mean_mm;
};
constexpr PaperRow kPaper[] = {{18, 1.107},  {48, 0.367},  {300, 0.064}, {578, 0.032},
                               {696, 0.020}, {908, 0.019}, {1072, 0.007}};

TEST(RotationFront, OfRemainingRotationIsBelowThePaper) {
  AdaptiveCorotation body = bent(RotationSource::kMeanGradient);
  const std::vector<FrontPoint> curve =
      refine_worst_first(body, Criterion::kRemainingRotation, Closure::kNone, 1080);
  for (const PaperRow& row : kPaper) {
    const FrontPoint& point = point_at(curve, row.rotation_tets);
    std::printf("%4u: %4u rotations, mean %.4f mm, max %.3f mm, threshold %.2e m3\n", row.rotation_tets,
                point.front.count(), point.error.mean_mm, point.error.max_mm, point.measure);
    EXPECT_GE(point.front.count(), 0.95 * row.rotation_tets);
    const double limit = row.rotation_tets >= 578 ? 0.25 * row.mean_mm : row.mean_mm;
    EXPECT_LE(point.error.mean_mm, limit);
  }
}

/// All at once instead of one at a time, and down from full corotation: the same thresholds give similar
/// fronts.
TEST(RotationFront, OfAThresholdFromBothSides) {
  AdaptiveCorotation body = bent(RotationSource::kMeanGradient);
  const double root_volume = bar_tree().tet[bar_tree().roots[0]].volume;
  struct Row {
    double threshold;  // of the root volume
    PaperRow paper;
  };
  constexpr Row kRows[] = {{3.66e-3, {48, 0.367}}, {1.61e-4, {300, 0.064}}, {7.66e-6, {578, 0.032}}};
  for (const Row& row : kRows) {
    const double threshold = row.threshold * root_volume;
    Front up(bar_tree());
    ASSERT_TRUE(adapt(body, up, threshold, 0.0));
    const double up_mm = body.error().mean_mm;
    Front down = Front::of_leaves(bar_tree());
    ASSERT_TRUE(adapt(body, down, threshold, 0.5 * threshold));
    std::printf(
        "threshold %.2e: from the roots %u, %.4f mm; from the leaves, merging at half of it, %u, %.4f mm\n",
        threshold, up.count(), up_mm, down.count(), body.error().mean_mm);
    EXPECT_LE(up.count(), row.paper.rotation_tets);
    EXPECT_LE(up_mm, row.paper.mean_mm);
    EXPECT_LE(body.error().mean_mm, row.paper.mean_mm);
    EXPECT_LE(down.count(), 1.3 * up.count());
  }
}

/// Both ends held, the middle of a long face pressed in by 20 mm: a local load needs its groups where it is.
TEST(RotationFront, OfRemainingRotationResolvesAnIndentation) {
  const reference::Mesh& mesh = bar_tree().mesh;
  AdaptiveCorotation body(bar_tree(), reference::indentation_problem(mesh, tissue(), 0.02),
                          RotationSource::kMeanGradient);
  const uint32_t pressed =
      reference::node_nearest(mesh, reference::Vector(reference::upper_corner(mesh)[0], 0, 0));
  const double full_mn = 1e3 * body.full().force[pressed].norm();
  EXPECT_NEAR(full_mn, 107.87, 0.05);
  const std::vector<FrontPoint> curve =
      refine_worst_first(body, Criterion::kRemainingRotation, Closure::kNone, 310);
  for (const uint32_t count : {48u, 100u, 300u}) {
    const FrontPoint& point = point_at(curve, count);
    EXPECT_LT(point.error.mean_mm, 0.04);
    EXPECT_LT(1e3 * (point.force[pressed] - body.full().force[pressed]).norm(), 0.3);
  }
}

TEST(FrontSearch, FindsFewerRotationsForTheSameError) {
  AdaptiveCorotation body = bent(RotationSource::kMeanGradient);
  const std::vector<Front> fronts = reference::search_fronts(body);
  const auto mean_mm_at = [&](uint32_t count, int rounds) {
    Front front = fronts[1152 - count];
    EXPECT_EQ(front.count(), count);
    polish(body, front, rounds);
    return body.error().mean_mm;
  };
  EXPECT_LT(mean_mm_at(48, 20), 0.380);
  EXPECT_LT(mean_mm_at(300, 5), 0.052);
  EXPECT_LT(mean_mm_at(578, 0), 0.0045);
  EXPECT_LT(mean_mm_at(696, 0), 0.0014);
}

}  // namespace
}  // namespace palpate::test
