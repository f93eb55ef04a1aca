#include "palpate/touch/grasp.hpp"

#include <gtest/gtest.h>

#include "support/bodies.hpp"
#include "support/forests.hpp"
#include "support/random.hpp"

namespace palpate::test {
namespace {

using Eigen::Vector3d;

class GraspTest : public testing::Test {
 protected:
  GraspTest() : forest_(roots_and_level_3()) {}

  static std::unique_ptr<Forest<Small>> roots_and_level_3() {
    auto forest = roots_of<Small>(bar_block());
    EXPECT_EQ(refine_uniformly(*forest, 3), MeshStatus::kDone);
    return forest;
  }

  void update(const Vector3d& tool, bool close) {
    if (opened_or_closes(*forest_, close, grasp_)) {
      close_grasp(*forest_, fixed_vector<Position>(tool), kReach, grasp_);
    }
  }

  static constexpr Position kReach = Position::ratio(1, 4);
  std::unique_ptr<Forest<Small>> forest_;
  Grasp grasp_ = Grasp::open();
};

TEST_F(GraspTest, PicksTheNearestNodeWithinReach) {
  Random random(111);
  uint32_t none = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vector3d tool = random.vector().cwiseProduct(Vector3d(1, 1, 2));
    uint16_t expected = kNone;
    double least = 0.25;
    for (uint32_t k = 0; k < forest_->nodes.used(); ++k) {
      const uint16_t node = forest_->nodes.live(k);
      const double distance = (doubles(forest_->node.position[node]) - tool).norm();
      if (distance < least) {
        least = distance;
        expected = node;
      }
    }
    EXPECT_EQ(nearest_node(*forest_, fixed_vector<Position>(tool), kReach), expected);
    none += expected == kNone ? 1u : 0u;
  }
  EXPECT_GT(none, 100u);
}

TEST_F(GraspTest, ReachIsClosedAndTiesGoToTheFirst) {
  const uint16_t corner = node_at(*forest_, {16, 16, 48});
  const Vector3<Position> at = forest_->node.position[corner];
  const Vector3<Position> just_in =
      at + Vector3<Position>(kReach, Position::from_raw(0), Position::from_raw(0));
  const Vector3<Position> just_out = just_in + fixed_vector<Position>(Vector3d(std::exp2(-27), 0, 0));
  EXPECT_EQ(nearest_node(*forest_, just_in, kReach), corner);
  EXPECT_EQ(nearest_node(*forest_, just_out, kReach), kNone);
  // Midway between two nodes: the one that stands first among the live ones.
  const uint16_t a = node_at(*forest_, {16, 16, 48});
  const uint16_t b = node_at(*forest_, {16, 16, 32});
  ASSERT_NE(b, kNone);
  const uint16_t nearest = nearest_node(*forest_, fixed_vector<Position>(Vector3d(0.5, 0.5, 1.25)), kReach);
  EXPECT_EQ(nearest, std::min(a, b));
}

TEST_F(GraspTest, ClosesOnTheEdgeOnly) {
  const Vector3d far(3, 3, 3);
  const Vector3d corner(0.5, 0.5, 1.5);
  update(far, true);
  EXPECT_FALSE(grasp_.holds());
  update(corner, true);  // still closed: no new edge
  EXPECT_FALSE(grasp_.holds());
  update(corner, false);
  update(corner, true);
  EXPECT_TRUE(grasp_.holds());
  EXPECT_EQ(grasp_.node, node_at(*forest_, {16, 16, 48}));
  update(Vector3d(-0.5, -0.5, -1.5), true);  // holds on to its node wherever the tool goes
  EXPECT_EQ(grasp_.node, node_at(*forest_, {16, 16, 48}));
  update(corner, false);
  EXPECT_FALSE(grasp_.holds());
}

TEST_F(GraspTest, KeepsTheOffsetOfTheMomentItClosed) {
  const Vector3d tool(0.45, 0.5, 1.55);
  update(tool, true);
  const uint16_t corner = node_at(*forest_, {16, 16, 48});
  EXPECT_EQ(grasp_.offset, forest_->node.position[corner] - fixed_vector<Position>(tool));
}

TEST_F(GraspTest, LetsGoOfANodeThatIsGone) {
  const Vector3d corner(0.5, 0.5, 1.5);
  update(corner, true);
  ASSERT_TRUE(grasp_.holds());
  forest_->nodes.release(grasp_.node);
  update(corner, true);
  EXPECT_FALSE(grasp_.holds());
  update(corner, true);
  EXPECT_FALSE(grasp_.holds());
}

/// The largest differences that a tool and a node can have stay within the formats.
TEST_F(GraspTest, SurvivesTheFarthestTool) {
  for (const int sign : {-1, 1}) {
    const Position limit = sign < 0 ? -kPositionLimit : kPositionLimit;
    const Position other = sign < 0 ? kPositionLimit : -kPositionLimit;
    for (auto& x : forest_->node.position) x = Vector3<Position>(other, other, other);
    const Vector3<Position> tool = within_position_limit(Vector3<Position>(limit, limit, limit));
    EXPECT_EQ(nearest_node(*forest_, tool, kReach), kNone);
    EXPECT_EQ(nearest_node(*forest_, tool, kPositionLimit), kNone);
  }
}

}  // namespace
}  // namespace palpate::test
