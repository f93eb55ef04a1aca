// What a change of the mesh must never do: merge a grasped node, rise above the rotation front, leave a
// region's levels, or go on for ever.
#include <gtest/gtest.h>

#include "support/remeshing.hpp"
#include "support/soak.hpp"

namespace palpate::test {
namespace {

struct Roomy : TestProfile<1152, 512, 6> {
  static constexpr uint16_t kGroups = 300;
  static constexpr uint32_t kPatches = 4;
};

TickInput tool_at(const Eigen::Vector3d& at, bool close) {
  TickInput input = input_at_rest();
  input.tool = fixed_vector<Position>(at);
  input.close_grasp = close;
  return input;
}

/// Leaves at a node, and the coarsest level of them.
uint8_t coarsest_at(const Forest<Roomy>& forest, uint16_t node) {
  uint8_t coarsest = 255;
  for (uint32_t i = 0; i < forest.leaf_count; ++i) {
    if (touches(forest.leaf[i], node)) coarsest = std::min(coarsest, forest.leaf[i].level());
  }
  return coarsest;
}

/// A node that only exists because the mesh is finer than it needs to be there: unless held, it would be
/// merged.
TEST(RemeshRules, AGraspedNodeStaysAndThePatchAroundItIsTheFinest) {
  const auto state = started<Roomy>(compile_model(remeshing_bar()));
  const LatticePoint point{16, 16, 0};
  const uint16_t node = node_at(state->forest, point);
  ASSERT_NE(node, kNone);
  const TickInput input = tool_at(Eigen::Vector3d(0.5, 0.5, 0.0), true);
  tick_once(*state, input);
  ASSERT_EQ(state->grasp.node, node);
  settle(*state, input, 200, 3000);
  EXPECT_EQ(state->grasp.node, node);
  EXPECT_EQ(node_at(state->forest, point), node);
  EXPECT_EQ(coarsest_at(state->forest, node), 5);
  EXPECT_LT(state->forest.leaf_count, 500u) << "only around the node";
  expect_whole(*state);
  const TickInput open = tool_at(Eigen::Vector3d(0.5, 0.5, 0.0), false);
  settle(*state, open, 200, 3000);
  EXPECT_EQ(state->forest.leaf_count, 18u << 2);
  EXPECT_EQ(node_at(state->forest, point), kNone) << "at level 2 no edge of a cube has a node in its middle";
}

/// A bar whose nodes have been drawn for `wait` ticks, and one of them; kNone if there is none.
std::unique_ptr<State<Roomy>> drawing(int wait, uint16_t& drawn) {
  auto state = started<Roomy>(compile_model(remeshing_bar()));
  for (int i = 0; i < wait; ++i) tick_once(*state, tool_at(Eigen::Vector3d::Zero(), false));
  drawn = kNone;
  for (uint32_t i = 0; i < state->tethers.count; ++i) {
    if (state->tethers.tether[i].kind == TetherKind::kDraw) drawn = state->tethers.tether[i].node;
  }
  return state;
}

/// Grasped while it is being drawn to its end, it is let go of and stays.
TEST(RemeshRules, ANodeThatIsGraspedWhileItIsDrawnStays) {
  uint32_t caught = 0;
  for (int wait = 1; wait < 60; wait += 3) {
    uint16_t drawn = kNone;
    const auto state = drawing(wait, drawn);
    if (drawn == kNone) continue;
    ++caught;
    const LatticePoint point = state->forest.node.rest[drawn];
    const TickInput input = tool_at(doubles(state->forest.node.position[drawn]), true);
    for (int i = 0; i < 300; ++i) {
      tick_once(*state, input);
      ASSERT_EQ(state->grasp.node, drawn);
      ASSERT_EQ(node_at(state->forest, point), drawn);
    }
    expect_whole(*state);
  }
  EXPECT_GT(caught, 3u);
}

/// The hand holds the node from then on and nothing else does: it feels what it would without the tether.
TEST(RemeshRules, ATetherLetsGoOfAGraspedNode) {
  uint32_t caught = 0;
  for (int wait = 1; wait < 60; wait += 3) {
    uint16_t drawn = kNone;
    const auto state = drawing(wait, drawn);
    if (drawn == kNone) continue;
    ++caught;
    const auto without = std::make_unique<State<Roomy>>(*state);
    for (uint32_t i = 0; i < without->tethers.count; ++i) {
      if (without->tethers.tether[i].node == drawn) without->tethers.remove(i);
    }
    Eigen::Vector3d at = doubles(state->forest.node.position[drawn]);
    for (int i = 0; i < 100; ++i) {
      const Vector3<Force> reaction = tick_once(*state, tool_at(at, true)).reaction;
      ASSERT_EQ(state->grasp.node, drawn);
      ASSERT_EQ(reaction, tick_once(*without, tool_at(at, true)).reaction) << "tick " << i;
      at[0] += 0.1 * 1e-3 / 0.064;  // 0.1 m/s
    }
  }
  EXPECT_GT(caught, 3u);
}

/// A hold of one point that is no corner of a root: the mesh stays as fine there as the node needs.
TEST(RemeshRules, AHeldNodeIsNotMergedAway) {
  Model model = compile_model(remeshing_bar());
  const LatticePoint point{16, 16, 0};  // in the middle of an edge of length 1, which level 2 would restore
  model.held = {LatticeBox{point, point}, LatticeBox{{1, 1, 1}, {0, 0, 0}}};
  const auto state = started<Roomy>(model);
  const uint16_t node = node_at(state->forest, point);
  ASSERT_NE(node, kNone);
  settle(*state, input_at_rest(), 200, 3000);
  EXPECT_EQ(node_at(state->forest, point), node);
  EXPECT_LT(state->forest.leaf_count, 18u << 3);
  EXPECT_GT(state->forest.leaf_count, 18u << 2);
  expect_whole(*state);
}

/// Groups on the leaves, which may not be joined: no leaf is merged. When they may, groups rise first.
TEST(RemeshRules, AMergeWaitsForTheRotationFront) {
  Model model = compile_model(remeshing_bar());
  model.remesh.rotation.start_level = 3;
  const auto state = started<Roomy>(model);
  for (int i = 0; i < 500; ++i) tick_once(*state, input_at_rest());
  EXPECT_EQ(state->remesh.merged, 0u);
  EXPECT_EQ(state->forest.leaf_count, 18u << 3);
  state->model.remesh.rotation.start_level = 0;
  uint32_t first_join = 0;
  uint32_t first_merge = 0;
  for (uint32_t i = 1; i <= 2000; ++i) {
    tick_once(*state, input_at_rest());
    if (first_join == 0 && state->remesh.groups_joined > 0) first_join = i;
    if (first_merge == 0 && state->remesh.merged > 0) first_merge = i;
    ASSERT_NO_FATAL_FAILURE(expect_whole(*state));
  }
  EXPECT_LT(first_join, first_merge);
  EXPECT_EQ(state->forest.leaf_count, 18u << 2);
  EXPECT_EQ(state->front.groups.used(), 18u);
}

/// Held in one shape, the fronts come to rest and stay there.
TEST(RemeshRules, NothingChattersAtAConstantDeformation) {
  for (const RotationCriterion rotation : {RotationCriterion::kMisfit, RotationCriterion::kSiblings}) {
    for (const StretchCriterion stretch :
         {StretchCriterion::kSixEdges, StretchCriterion::kLongestEdge, StretchCriterion::kStrainJump}) {
      for (const double part : {0.3, 0.6, 1.0}) {
        sim::ModelParameters parameters = remeshing_bar();
        parameters.held = sim::HeldEnds::kBoth;
        parameters.remesh.rotation = rotation;
        parameters.remesh.stretch = stretch;
        if (stretch == StretchCriterion::kStrainJump) parameters.remesh.stretch_split = 0.1;
        const auto state = started<Roomy>(compile_model(parameters));
        const auto at = [&](double p) { return pulled(0.3 * p, 0.4 * p, 0.6 * p); };
        for (int i = 1; i <= 300; ++i) tick_once(*state, at(part * i / 300.0));
        const uint32_t last = settle(*state, at(part), 200, 4000);
        std::printf("rotation %d, stretch %d, load %.1f: at rest after %u ticks, %u leaves, %u groups\n",
                    static_cast<int>(rotation), static_cast<int>(stretch), part, last,
                    unsigned{state->forest.leaf_count}, unsigned{state->front.groups.used()});
        EXPECT_LT(last, 3800u);
      }
    }
  }
}

/// Of longest edges none that a leaf has looked at is the one that a merge restores: before its middle is
/// drawn, it must be calm too. With the upper threshold as limit of both the drawing and the merge, a drawn
/// node could push the edge over it and be let go, for ever.
TEST(RemeshRules, ANodeIsDrawnOnlyFromACalmEdge) {
  sim::ModelParameters parameters = remeshing_bar();
  parameters.held = sim::HeldEnds::kBoth;
  parameters.remesh.stretch = StretchCriterion::kLongestEdge;
  parameters.remesh.stretch_split = 0.02;
  const auto state = started<Roomy>(compile_model(parameters));
  const StretchRules& rules = state->model.remesh.stretch;
  uint32_t drawn = 0;
  for (int i = 0; i < in_soak(50000, 3000); ++i) {
    const double part = 0.5 - 0.5 * std::cos(i * 2.0 * 3.14159 / 1500.0);
    // The edges as the re-mesh stage sees them; what it begins to draw shows after the tick.
    const auto before = state->forest.node.position;
    tick_once(*state, pulled(0.5 * part, 0.8 * part, 0.4 * part));
    NodeState<Roomy::kNodes> nodes = state->forest.node;
    nodes.position = before;
    for (uint32_t k = 0; k < state->tethers.count; ++k) {
      const Tether& tether = state->tethers.tether[k];
      if (tether.kind != TetherKind::kDraw || tether.ticks_left != kTetherTicks) continue;
      ++drawn;
      const uint8_t level = state->forest.level_of(tether.tet);
      ASSERT_LE(refinement_edge_stretch(nodes, tether.end, level), rules.merge_below);
    }
  }
  EXPECT_GT(drawn, 50u);
}

/// Two regions side by side with ranges that do not overlap: no closure of the finer one passes the coarser
/// one's.
TEST(RemeshRules, EveryLeafStaysWithinTheLevelsOfItsRegion) {
  sim::ModelParameters parameters = remeshing_bar();
  parameters.held = sim::HeldEnds::kBoth;
  parameters.regions = {{500.0, 0.45, 1000.0, 3, 5}, {500.0, 0.45, 1000.0, 1, 3}};
  parameters.region_of_cube = {0, 1, 0};
  const auto state = started<Roomy>(compile_model(parameters));
  uint8_t coarsest[2] = {255, 255};
  uint8_t finest[2] = {0, 0};
  for (int i = 0; i < in_soak(50000, 3000); ++i) {
    const double part = 0.5 - 0.5 * std::cos(i * 2.0 * 3.14159 / 1500.0);
    tick_once(*state, pulled(0.5 * part, 0.8 * part, 0.4 * part));
    for (uint32_t k = 0; k < state->forest.leaf_count; ++k) {
      const Leaf& leaf = state->forest.leaf[k];
      coarsest[leaf.region()] = std::min(coarsest[leaf.region()], leaf.level());
      finest[leaf.region()] = std::max(finest[leaf.region()], leaf.level());
    }
  }
  std::printf("levels %u to %u and %u to %u\n", unsigned{coarsest[0]}, unsigned{finest[0]},
              unsigned{coarsest[1]}, unsigned{finest[1]});
  EXPECT_GE(coarsest[0], 3);
  EXPECT_EQ(finest[0], 5);
  EXPECT_GE(coarsest[1], 1);
  EXPECT_EQ(finest[1], 3);
  expect_whole(*state);
}

}  // namespace
}  // namespace palpate::test
