// Whole ticks: grasping and its reaction, clamps and their flags, momentum, symmetry, rest, and two
// materials.
#include <gtest/gtest.h>

#include "support/bodies.hpp"
#include "support/forests.hpp"

namespace palpate::test {
namespace {

using SmallProfile = WithFullCorotation<Small>;
using Eigen::Vector3d;

constexpr LatticePoint kFreeCorner{16, 16, 48};

bool has(const TickOutput& output, TickFlag flag) {
  return (output.flags & static_cast<uint32_t>(flag)) != 0;
}

TickInput at_corner(const Vector3d& displacement, bool close) {
  TickInput input = input_at_rest();
  input.tool = fixed_vector<Position>(Vector3d(0.5, 0.5, 1.5) + displacement);
  input.close_grasp = close;
  return input;
}

TEST(TickBody, AtRestNothingHappens) {
  for (const int level : {0, 1, 2, 3}) {
    sim::ModelParameters parameters = coarse_bar(1000.0, 1);
    parameters.level = level;
    const auto state = started<SmallProfile>(compile_model(parameters));
    for (int i = 0; i < 100; ++i) {
      const TickOutput output = tick_once(*state, input_at_rest());
      ASSERT_EQ(output.flags, 0u);
      ASSERT_EQ(output.reaction, zero_vector<Force>());
    }
    EXPECT_EQ(state->tick, 100u);
    for (uint32_t i = 0; i < state->forest.nodes.used(); ++i) {
      EXPECT_EQ(state->forest.node.position[i], rest_position(state->forest.node.rest[i]));
    }
  }
}

TEST(TickBody, AGraspPullsBackAndAnOpenOneDoesNot) {
  const auto state = started<SmallProfile>(compile_model(coarse_bar(1000.0, 1)));
  const uint16_t corner = node_at(state->forest, kFreeCorner);
  TickOutput output = tick_once(*state, at_corner(Vector3d::Zero(), false));
  EXPECT_FALSE(has(output, TickFlag::kGrasping));
  for (int i = 1; i <= 100; ++i) {
    output = tick_once(*state, at_corner(Vector3d(0.001 * i, 0, 0), true));
    ASSERT_TRUE(has(output, TickFlag::kGrasping));
    ASSERT_EQ(state->grasp.node, corner);
  }
  EXPECT_LT(output.reaction[0].raw(), 0);  // the tissue pulls the tool back
  // The node follows the tool with the offset that it had when the grasp closed.
  EXPECT_NEAR(sim::to_double(state->forest.node.position[corner][0]), 0.599, 1e-7);
  output = tick_once(*state, at_corner(Vector3d(0.1, 0, 0), false));
  EXPECT_EQ(output.reaction, zero_vector<Force>());
  EXPECT_FALSE(has(output, TickFlag::kGrasping));
}

TEST(TickBody, AGraspBeyondReachHoldsNothing) {
  const auto state = started<SmallProfile>(compile_model(coarse_bar(1000.0, 1)));
  TickInput input = at_corner(Vector3d(0.2, 0, 0), true);  // reach is 10 mm = 0.156 edge
  const TickOutput output = tick_once(*state, input);
  EXPECT_FALSE(has(output, TickFlag::kGrasping));
  EXPECT_EQ(output.reaction, zero_vector<Force>());
}

TEST(TickBody, AbsurdSpeedIsFlaggedForItsTicksOnlyAndCounted) {
  const auto state = started<SmallProfile>(compile_model(coarse_bar(1000.0, 1)));
  EXPECT_EQ(tick_once(*state, at_corner(Vector3d::Zero(), true)).flags,
            static_cast<uint32_t>(TickFlag::kGrasping));
  const TickOutput output = tick_once(*state, at_corner(Vector3d(1, 0, 0), true));
  EXPECT_TRUE(has(output, TickFlag::kSpeedClamped));
  EXPECT_EQ(state->clamps.speed, 1u);
  // Back where the node is by now: calm again, and the counter stays.
  tick_once(*state, at_corner(Vector3d(1.0 / 32, 0, 0), true));
  for (int i = 0; i < 50; ++i) tick_once(*state, at_corner(Vector3d(1.0 / 32, 0, 0), true));
  EXPECT_FALSE(has(tick_once(*state, at_corner(Vector3d(1.0 / 32, 0, 0), true)), TickFlag::kSpeedClamped));
  EXPECT_GE(state->clamps.speed, 1u);
}

TEST(TickBody, AbsurdPullsFlagStrainAndPosition) {
  const auto state = started<SmallProfile>(compile_model(coarse_bar(1000.0, 1)));
  bool strain = false;
  for (int i = 0; i < 1500; ++i) {
    const TickOutput output = tick_once(*state, at_corner(Vector3d(0.01 * i, 0, 0), true));
    strain = strain || has(output, TickFlag::kStrainClamped);
  }
  EXPECT_TRUE(strain);
  EXPECT_GT(state->clamps.strain, 0u);
  const uint16_t corner = node_at(state->forest, kFreeCorner);
  EXPECT_EQ(state->forest.node.position[corner][0], kPositionLimit);  // the tool's goal is limited
}

TEST(TickBody, StartRefusesWhatDoesNotFit) {
  auto state = std::make_unique<State<TestProfile<100, 300, 6>>>();
  EXPECT_EQ(start(*state, compile_model(coarse_bar(1000.0, 1))), Status::kTooManyLeaves);
  auto nodes = std::make_unique<State<TestProfile<300, 50, 6>>>();
  EXPECT_EQ(start(*nodes, compile_model(coarse_bar(1000.0, 1))), Status::kTooManyNodes);
  auto level = std::make_unique<State<TestProfile<300, 300, 2>>>();
  EXPECT_EQ(start(*level, compile_model(coarse_bar(1000.0, 1))), Status::kLevelTooDeep);
}

/// Where the profile has no code for studies.
TEST(TickBody, StartRefusesACriterionThatIsNotBuilt) {
  auto state = std::make_unique<State<CuboidDense>>();
  Model model = compile_model(coarse_bar(1000.0, 1));
  for (const RotationCriterion criterion : {RotationCriterion::kSiblings, RotationCriterion::kFull}) {
    model.remesh.rotation.criterion = criterion;
    EXPECT_EQ(start(*state, model), Status::kNoSuchCriterion);
  }
  model.remesh.rotation.criterion = RotationCriterion::kMisfit;
  EXPECT_EQ(start(*state, model), Status::kDone);
  model.remesh.stretch.criterion = StretchCriterion::kStrainJump;
  EXPECT_EQ(start(*state, model), Status::kNoSuchCriterion);
}

TEST(TickBody, StartRefusesMoreSubstepsThanTheProfileHas) {
  auto state = std::make_unique<State<CuboidDense>>();
  sim::ModelParameters parameters = coarse_bar(1000.0, 2);
  parameters.remesh.rotation = RotationCriterion::kMisfit;
  EXPECT_EQ(start(*state, compile_model(parameters)), Status::kTooManySubsteps);
  parameters.substeps = 1;
  EXPECT_EQ(start(*state, compile_model(parameters)), Status::kDone);
}

/// Levels that a mesh would change to are the profile's, and the start's is among them.
TEST(TickBody, StartRefusesLevelsThatCannotBe) {
  using Deep = TestProfile<300, 300, 5>;
  Model model = compile_model(coarse_bar(1000.0, 1));  // level 3
  const auto status_with = [&](LevelRange last_region) {
    auto state = std::make_unique<State<Deep>>();
    model.remesh.stretch.levels.back() = last_region;
    return start(*state, model);
  };
  EXPECT_EQ(status_with({9, 1}), Status::kDone) << "a mesh that is fixed has no use for them";
  model.remesh.stretch.criterion = StretchCriterion::kSixEdges;
  EXPECT_EQ(status_with({0, 5}), Status::kDone);
  EXPECT_EQ(status_with({3, 3}), Status::kDone);
  EXPECT_EQ(status_with({3, 6}), Status::kLevelTooDeep);
  EXPECT_EQ(status_with({4, 5}), Status::kLevelsContradictory);
  EXPECT_EQ(status_with({0, 2}), Status::kLevelsContradictory);
  EXPECT_EQ(status_with({4, 2}), Status::kLevelsContradictory);
}

/// The same model and input, twice: the same bits.
TEST(TickBody, IsDeterministic) {
  uint64_t hash[2] = {0, 0};
  for (uint64_t& value : hash) {
    const auto state = started<SmallProfile>(compile_model(coarse_bar(10.0, 4)));
    TickOutput output{};
    for (int i = 0; i < 200; ++i) output = tick_once(*state, at_corner(Vector3d(0, 0.002 * i, 0), true));
    value = state_hash(*state, output);
  }
  EXPECT_EQ(hash[0], hash[1]);
}

}  // namespace
}  // namespace palpate::test
