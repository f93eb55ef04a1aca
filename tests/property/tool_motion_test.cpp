// Random tools that grasp, pull at up to 1 m/s and let go. In the checked build (PALPATE_CHECKED) any
// operation that leaves its range aborts, so there these tests are the proof that none does.
#include <gtest/gtest.h>

#include "support/bodies.hpp"
#include "support/forests.hpp"
#include "support/random.hpp"
#include "support/soak.hpp"

namespace palpate::test {
namespace {

using SmallProfile = WithFullCorotation<Small>;
using Eigen::Vector3d;

/// A tool that goes from place to place near the body at up to `speed_m_s`.
class Wanderer {
 public:
  Wanderer(Random& random, double edge_m, double speed_m_s)
      : random_(random), step_(speed_m_s * 1e-3 / edge_m) {}

  Vector3<Position> next() {
    if ((goal_ - at_).norm() < step_) goal_ = random_.vector().cwiseProduct(Vector3d(1.0, 1.0, 2.0));
    at_ += std::min(step_, (goal_ - at_).norm()) * (goal_ - at_).normalized();
    return fixed_vector<Position>(at_);
  }

 private:
  Random& random_;
  double step_;
  Vector3d at_ = Vector3d(0.5, 0.5, 1.5);
  Vector3d goal_ = at_;
};

void expect_within_limits(const Forest<SmallProfile>& forest) {
  for (uint32_t i = 0; i < forest.nodes.used(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const Position x = forest.node.position[forest.nodes.live(i)][axis];
      ASSERT_LE(x, kPositionLimit);
      ASSERT_GE(x, -kPositionLimit);
    }
  }
}

/// Returns the ticks in which it held a node.
uint32_t wander(const sim::ModelParameters& parameters, double speed_m_s, uint64_t seed) {
  Random random(seed);
  auto state = started<SmallProfile>(compile_model(parameters));
  Wanderer wanderer(random, parameters.edge_m, speed_m_s);
  TickInput input = input_at_rest();
  uint32_t grasping = 0;
  for (int i = 0; i < 500; ++i) {
    input.tool = wanderer.next();
    if (random.below(100) == 0) input.close_grasp = !input.close_grasp;
    const TickOutput output = tick_once(*state, input);
    grasping += (output.flags & static_cast<uint32_t>(TickFlag::kGrasping)) != 0 ? 1u : 0u;
    expect_within_limits(state->forest);
    if (testing::Test::HasFatalFailure()) break;
  }
  EXPECT_EQ(check_forest(state->forest, state->model.block), Violation::kNothing);
  return grasping;
}

void wander_often(sim::ModelParameters parameters, double speed_m_s, uint32_t runs) {
  parameters.grasp_reach_m = 0.25;
  uint32_t grasping = 0;
  for (uint64_t seed = 0; seed < in_soak(100 * runs, runs); ++seed)
    grasping += wander(parameters, speed_m_s, seed);
  EXPECT_GT(grasping, 100 * runs);
}

TEST(ToolMotion, StaysWithinRangeOnTissue) { wander_often(coarse_bar(1000.0, 1), 1.0, 4); }
TEST(ToolMotion, StaysWithinRangeOnTheLightBar) { wander_often(coarse_bar(10.0, 4), 1.0, 4); }
TEST(ToolMotion, StaysWithinRangeOfAStiffBody) {
  sim::ModelParameters parameters = coarse_bar(1000.0, 8);
  parameters.regions[0].youngs_modulus_pa = 5e4;
  wander_often(parameters, 1.0, 2);
}
TEST(ToolMotion, StaysWithinRangeNearlyIncompressible) {
  sim::ModelParameters parameters = coarse_bar(1000.0, 1);
  parameters.regions[0].poisson_ratio = 0.495;
  wander_often(parameters, 1.0, 2);
}
TEST(ToolMotion, StaysWithinRangeAtAbsurdSpeed) { wander_often(coarse_bar(1000.0, 1), 100.0, 4); }
TEST(ToolMotion, StaysWithinRangeOfAFreeBody) {
  sim::ModelParameters parameters = coarse_bar(1000.0, 1);
  parameters.held = sim::HeldEnds::kNone;
  wander_often(parameters, 3.0, 3);
}

}  // namespace
}  // namespace palpate::test
