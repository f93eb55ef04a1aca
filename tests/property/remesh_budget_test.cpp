// Changes of both fronts within their budgets: never more in a tick than a profile allows, and nobody
// forgotten.
#include <gtest/gtest.h>

#include "support/remeshing.hpp"
#include "support/soak.hpp"

namespace palpate::test {
namespace {

struct OnePatch : TestProfile<1152, 512, 6> {
  static constexpr uint16_t kGroups = 200;
  static constexpr uint32_t kPatches = 1;
  static constexpr uint32_t kTetsSplit = 8;
  static constexpr uint32_t kTetsMerged = 8;
  static constexpr uint32_t kRotationChanges = 2;
  static constexpr uint16_t kTethers = 40;
};
struct FewTets : OnePatch {
  static constexpr uint32_t kPatches = 4;
  static constexpr uint32_t kRotationChanges = 8;
};

/// Pulls, twists and bends the bar, lets it go, and again: every budget of every tick.
template <class Profile>
void expect_within_budgets(RotationCriterion criterion) {
  sim::ModelParameters parameters = remeshing_bar();
  parameters.held = sim::HeldEnds::kBoth;
  parameters.remesh.rotation = criterion;
  const auto state = started<Profile>(compile_model(parameters));
  ChangeWatch<Profile> watch(*state);
  Changes most{};
  const auto see = [](uint32_t& so_far, uint32_t now) { so_far = std::max(so_far, now); };
  const int ticks = in_soak(100000, 2400);
  for (int i = 0; i < ticks; ++i) {
    const double pull = 0.5 - 0.5 * std::cos(i * 2.0 * 3.14159 / 800.0);
    tick_once(*state, pulled(0.45 * pull, 0.5 * pull, 0.7 * pull));
    const Changes now = watch.changes();
    see(most.patches_split, now.patches_split);
    see(most.patches_merged, now.patches_merged);
    see(most.tets_split, now.tets_split);
    see(most.tets_merged, now.tets_merged);
    see(most.groups_split, now.groups_split + now.joins_begun);
    if (i % 100 == 0) {
      ASSERT_NO_FATAL_FAILURE(expect_whole(*state));
    }
  }
  std::printf(
      "at most %u of %u patches (%u of %u tets) split, %u (%u of %u) merged, %u of %u rotations changed a "
      "tick; "
      "%u tets bisected, %u merged, %u groups split, %u joined\n",
      most.patches_split, Profile::kPatches, most.tets_split, Profile::kTetsSplit, most.patches_merged,
      most.tets_merged, Profile::kTetsMerged, most.groups_split, Profile::kRotationChanges,
      state->remesh.bisected, state->remesh.merged, state->remesh.groups_split, state->remesh.groups_joined);
  EXPECT_LE(most.patches_split, Profile::kPatches);
  EXPECT_LE(most.patches_merged, Profile::kPatches);
  EXPECT_LE(most.tets_split, Profile::kTetsSplit);
  EXPECT_LE(most.tets_merged, Profile::kTetsMerged);
  EXPECT_LE(most.groups_split, Profile::kRotationChanges);
  EXPECT_GT(state->remesh.bisected, 100u);
  EXPECT_GT(state->remesh.merged, 100u);
  EXPECT_GT(state->remesh.groups_split, 20u);
  EXPECT_GT(state->remesh.groups_joined, 10u);
}

TEST(RemeshBudget, IsNeverPassedWithOnePatch) { expect_within_budgets<OnePatch>(RotationCriterion::kMisfit); }
TEST(RemeshBudget, IsNeverPassedWithFewTets) { expect_within_budgets<FewTets>(RotationCriterion::kMisfit); }
TEST(RemeshBudget, IsNeverPassedByAConformingFront) {
  expect_within_budgets<FewTets>(RotationCriterion::kSiblings);
}

/// A still bar, its lower end pulled a little beyond the threshold and its upper end a lot: two regions, of
/// which the upper one may go so deep that it always wants more.
struct Wide : TestProfile<6000, 2600, 12> {
  static constexpr uint16_t kGroups = 18;
  static constexpr uint32_t kPatches = 1;
  static constexpr uint32_t kTetsSplit = 8;
  static constexpr uint16_t kTethers = 64;
};

std::unique_ptr<State<Wide>> two_queues() {
  sim::ModelParameters parameters = remeshing_bar();
  parameters.regions = {{500.0, 0.45, 1000.0, 0, 4}, {500.0, 0.45, 1000.0, 0, 9}};
  parameters.region_of_cube = {0, 0, 1};
  parameters.substeps = 4;
  auto state = started<Wide>(compile_model(parameters));
  for (uint32_t i = 0; i < state->forest.nodes.used(); ++i) {
    const uint16_t node = state->forest.nodes.live(i);
    Eigen::Vector3d x = doubles(rest_position(state->forest.node.rest[node]));
    const double upper = std::max(0.0, x[2] - 0.5);
    x[2] += 0.06 * x[2] + 1.2 * upper;
    state->forest.node.position[node] = fixed_vector<Position>(x);
  }
  return state;
}

/// While worse requests never end, every early one is done within a bound. An urgency grows by one with every
/// renewal and starts at most some 20 classes lower than the worst: after 20 sweeps no newcomer is ahead, and
/// those who are wait for one patch a tick.
TEST(RemeshBudget, NoRequestStarvesBehindWorseOnes) {
  const auto state = two_queues();
  std::vector<uint16_t> early;
  for (uint32_t i = 0; i < state->forest.leaf_count; ++i) {
    const Leaf& leaf = state->forest.leaf[i];
    if (leaf.region() == 0 && leaf.level() < 4 &&
        largest_edge_stretch(state->forest, leaf) > state->model.remesh.stretch.split_above) {
      early.push_back(leaf.tet);
    }
  }
  ASSERT_GT(early.size(), 50u);
  const uint32_t all = state->forest.leaf_count;
  uint32_t ticks = 0;
  uint32_t worse_done = 0;
  uint32_t left = static_cast<uint32_t>(early.size());
  const uint32_t bound = all + 20 * kSweepSlices * 4;
  while (left > 0 && ticks < 4 * bound) {
    change_fronts(*state);
    ++ticks;
    left = 0;
    for (const uint16_t tet : early) left += state->forest.tet[tet].is_leaf() ? 1u : 0u;
  }
  for (uint32_t i = 0; i < state->forest.leaf_count; ++i)
    worse_done += state->forest.leaf[i].level() > 4 ? 1u : 0u;
  std::printf("%zu early requests done in %u ticks (bound %u), beside %u deeper leaves; %u wait\n",
              early.size(), ticks, bound, worse_done, unsigned{state->remesh.leaves_waiting});
  EXPECT_EQ(left, 0u);
  EXPECT_LE(ticks, bound);
  EXPECT_GT(state->remesh.leaves_waiting, 20u);
  EXPECT_EQ(check_forest(state->forest, state->model.block), Violation::kNothing);
}

/// Many requests at once, one patch a tick: all are done in the end, whatever the order.
TEST(RemeshBudget, EveryRequestIsDoneWhenNoNewOnesCome) {
  sim::ModelParameters parameters = remeshing_bar();
  parameters.held = sim::HeldEnds::kBoth;
  const auto state = started<OnePatch>(compile_model(parameters));
  uint32_t most = 0;
  for (int i = 1; i <= 30; ++i) {
    tick_once(*state, pulled(0.3 * i / 30.0));
    most = std::max<uint32_t>(most, state->remesh.leaves_waiting);
  }
  uint32_t ticks = 0;
  TickOutput output{};
  do {
    output = tick_once(*state, pulled(0.3));
    most = std::max<uint32_t>(most, state->remesh.leaves_waiting);
  } while (++ticks < 3000 && (state->remesh.leaves_waiting > 0 || state->remesh.groups_waiting > 0));
  std::printf("%u leaves waited; after %u ticks none\n", most, ticks);
  EXPECT_GT(most, 10u);
  EXPECT_LT(ticks, 3000u);
  settle(*state, pulled(0.3), 300, 3000);
  output = tick_once(*state, pulled(0.3));
  EXPECT_EQ(output.flags, 0u);
  for (uint32_t i = 0; i < state->forest.leaf_count; ++i) {
    const Leaf& leaf = state->forest.leaf[i];
    const bool wants = largest_edge_stretch(state->forest, leaf) > state->model.remesh.stretch.split_above;
    EXPECT_FALSE(wants && leaf.level() < 5);
  }
}

}  // namespace
}  // namespace palpate::test
