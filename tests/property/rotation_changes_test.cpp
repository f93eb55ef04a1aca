// Who is split and joined first, together with whom, and however the body moves meanwhile.
#include <gtest/gtest.h>

#include "support/remeshing.hpp"

namespace palpate::test {
namespace {

struct Ample : TestProfile<1152, 512, 6> {
  static constexpr uint16_t kGroups = 1152;
  static constexpr uint32_t kRotationChanges = 200;
};

/// Held at both ends and of fixed mesh at this level.
sim::ModelParameters fixed_bar(RotationCriterion criterion, int level) {
  sim::ModelParameters parameters = remeshing_bar();
  parameters.held = sim::HeldEnds::kBoth;
  parameters.level = level;
  parameters.remesh.stretch = StretchCriterion::kFixed;
  parameters.remesh.rotation = criterion;
  return parameters;
}

/// The far end turned across the bar, then both about the x axis.
TickInput bent_and_spun(double bend, double spin) {
  const Eigen::Matrix3d spun = Eigen::AngleAxisd(spin, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const Eigen::Matrix3d bent = Eigen::AngleAxisd(bend, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const Eigen::Vector3d end(0, 0, 1.5);
  TickInput input = input_at_rest();
  input.hold_motion[0].rotation = fixed_matrix<RotationEntry>(spun);
  input.hold_motion[1].rotation = fixed_matrix<RotationEntry>(Eigen::Matrix3d(spun * bent));
  input.hold_motion[1].translation = fixed_vector<Position>(Eigen::Vector3d(spun * (end - bent * end)));
  return input;
}

struct Cycle {
  uint32_t split, joined, peak, left;
  uint32_t flagged_in_vain;  // ticks that name the budget with much of it left
};

/// Bends the bar by a radian and straightens it, all of it turning at so many degrees a second.
template <class Profile>
Cycle bend_and_straighten(const sim::ModelParameters& parameters, double degrees_per_s) {
  const auto state = started<Profile>(compile_model(parameters));
  ChangeWatch<Profile> watch(*state);
  Cycle cycle{};
  for (int i = 0; i < 2400; ++i) {
    const double bend = i < 600 ? i / 600.0 : i < 1000 ? 1.0 : i < 1600 ? (1600 - i) / 600.0 : 0.0;
    const TickOutput output = tick_once(*state, bent_and_spun(bend, degrees_per_s * i * 3.14159265 / 180e3));
    const Changes made = watch.changes();
    const bool has_left = made.groups_split + made.joins_begun + 2 * kMaxPatch < Profile::kRotationChanges;
    cycle.flagged_in_vain += has_left && has(output, TickFlag::kRotationBudget) ? 1u : 0u;
    cycle.peak = std::max<uint32_t>(cycle.peak, state->front.groups.used());
    if (i % 3 == 0) expect_whole(*state);
    if (testing::Test::HasFatalFailure()) break;
  }
  cycle.split = state->remesh.groups_split;
  cycle.joined = state->remesh.groups_joined;
  cycle.left = state->front.groups.used();
  std::printf("%.0f deg/s: %u split, %u joined, at most %u groups, %u at the end\n", degrees_per_s,
              cycle.split, cycle.joined, cycle.peak, cycle.left);
  return cycle;
}

TEST(RotationChanges, PairsAreJoinedHoweverTheBodyTurns) {
  sim::ModelParameters parameters = fixed_bar(RotationCriterion::kSiblings, 5);
  parameters.remesh.rotation_split_deg = 1.5;
  parameters.regions[0].density_kg_m3 = 10.0;  // light, so that turning does not bend it
  parameters.mass_damping_per_s = 4.0;
  parameters.substeps = 4;
  for (const double degrees_per_s : {0.0, 30.0, 90.0}) {
    const Cycle cycle = bend_and_straighten<Ample>(parameters, degrees_per_s);
    EXPECT_GT(cycle.peak, 150u);
    EXPECT_LT(cycle.left, 40u);
    EXPECT_EQ(cycle.flagged_in_vain, 0u);
  }
}

/// A budget of a patch or two, so that splits and joins get in each other's way: a pair that is about to be
/// joined is split, and what began with it parts.
struct Narrow : Ample {
  static constexpr uint32_t kRotationChanges = 10;
};
TEST(RotationChanges, AFrontConformsWhenPairsPart) {
  sim::ModelParameters parameters = fixed_bar(RotationCriterion::kSiblings, 5);
  parameters.remesh.rotation_split_deg = 1.0;
  const auto state = started<Narrow>(compile_model(parameters));
  std::set<std::pair<uint16_t, uint16_t>> pairs;
  uint32_t parted = 0;
  for (int i = 0; i < 1500; ++i) {
    const double phase = i * 2.0 * 3.14159265 / 300.0;
    tick_once(*state, pulled(0.0, 0.7 * std::sin(phase), 0.8 * std::sin(0.7 * phase)));
    std::set<std::pair<uint16_t, uint16_t>> now;
    for (uint32_t k = 0; k < state->front.groups.used(); ++k) {
      const uint16_t group = state->front.groups.live(k);
      if (state->front.partner[group] != kNone) now.emplace(group, state->front.tet[group]);
    }
    for (const auto& [group, tet] : pairs) {
      const bool joined =
          state->front.tet[group] == state->forest.parent_of(tet) || !state->front.groups.is_live(group);
      parted += !joined && now.count({group, tet}) == 0 ? 1u : 0u;
    }
    pairs = now;
    ASSERT_NO_FATAL_FAILURE(expect_whole(*state));
  }
  std::printf("%u parted, %u joined\n", parted, state->remesh.groups_joined);
  EXPECT_GT(parted, 10u);
  EXPECT_GT(state->remesh.groups_joined, 10u);
}

/// Misfits a little above the threshold everywhere, and of the last group much above it.
template <class Profile>
uint16_t make_the_last_one_worst(State<Profile>& state) {
  const auto above = static_cast<int32_t>(state.model.remesh.rotation.split_above);
  const uint32_t count = state.front.groups.used();
  for (uint32_t i = 0; i < count; ++i) {
    state.groups.misfit[state.front.groups.live(i)] = Misfit::from_raw(above + above / 100);
  }
  const uint16_t worst = state.front.groups.live(count - 1);
  state.groups.misfit[worst] = Misfit::from_raw(16 * above);
  return worst;
}

struct TwoChanges : Ample {
  static constexpr uint32_t kRotationChanges = 2;
};
TEST(RotationChanges, TheWorstGroupIsSplitFirst) {
  const auto state = started<TwoChanges>(compile_model(fixed_bar(RotationCriterion::kMisfit, 4)));
  const uint16_t worst = make_the_last_one_worst(*state);
  const uint16_t tet = state->front.tet[worst];
  change_fronts(*state);
  EXPECT_EQ(state->remesh.groups_split, 2u);
  EXPECT_EQ(state->front.tet[worst], state->forest.child(tet, 0));
  EXPECT_EQ(state->remesh.groups_waiting, 16);
  EXPECT_EQ(state->waiting.all(), static_cast<uint32_t>(RemeshFlag::kRotationBudget));
}

struct OneMoreGroup : Ample {
  static constexpr uint16_t kGroups = 19;
};
TEST(RotationChanges, TheWorstGroupGetsTheLastFreeOne) {
  const auto state = started<OneMoreGroup>(compile_model(fixed_bar(RotationCriterion::kMisfit, 4)));
  const uint16_t worst = make_the_last_one_worst(*state);
  const uint16_t tet = state->front.tet[worst];
  change_fronts(*state);
  EXPECT_EQ(state->remesh.groups_split, 1u);
  EXPECT_EQ(state->front.tet[worst], state->forest.child(tet, 0));
  EXPECT_EQ(state->waiting.all(), static_cast<uint32_t>(RemeshFlag::kGroups));
}

/// All that fit are split, and no flag says otherwise, when the budget is just enough.
struct JustEnough : Ample {
  static constexpr uint32_t kRotationChanges = 18;
};
TEST(RotationChanges, ABudgetThatIsJustEnoughIsNotNamed) {
  const auto state = started<JustEnough>(compile_model(fixed_bar(RotationCriterion::kMisfit, 4)));
  make_the_last_one_worst(*state);
  change_fronts(*state);
  EXPECT_EQ(state->remesh.groups_split, 18u);
  EXPECT_EQ(state->remesh.groups_waiting, 0);
  EXPECT_EQ(state->waiting.all(), 0u);
}

/// A tick looks at a slice of the front for pairs, and in kPairTurns at all of it.
struct FourPairs : Ample {
  static constexpr uint16_t kGroups = 64;
};
uint32_t groups_in_pairs(const State<FourPairs>& state) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < state.front.groups.used(); ++i) {
    count += state.front.partner[state.front.groups.live(i)] != kNone ? 1u : 0u;
  }
  return count;
}
void wake_calm(State<FourPairs>& state) {
  for (uint32_t i = 0; i < state.front.groups.used(); ++i) {
    state.groups.blend[state.front.groups.live(i)] = 0;
    state.groups.misfit[state.front.groups.live(i)] = Misfit::from_raw(0);
    state.groups.misfit_left[state.front.groups.live(i)] = Misfit::from_raw(0);
  }
}
TEST(RotationChanges, CalmPairsBeginAndEndWithinATurn) {
  const auto state = started<FourPairs>(compile_model(fixed_bar(RotationCriterion::kMisfit, 4)));
  make_the_last_one_worst(*state);
  change_fronts(*state);
  ASSERT_EQ(state->front.groups.used(), 36);
  wake_calm(*state);
  change_fronts(*state);
  EXPECT_GT(groups_in_pairs(*state), 0u);
  EXPECT_LE(groups_in_pairs(*state), 2 * 64 / kPairTurns);
  for (uint32_t tick = 0; tick < kPairTurns; ++tick) change_fronts(*state);
  EXPECT_EQ(groups_in_pairs(*state), 36u);
  wake_calm(*state);
  // A pair may miss its turn, when the group that it is known by moves.
  for (uint32_t tick = 0; tick < 2 * kPairTurns; ++tick) change_fronts(*state);
  EXPECT_EQ(state->front.groups.used(), 18);
  EXPECT_EQ(state->remesh.groups_joined, 18u);
  EXPECT_EQ(check_front(state->forest, state->front), FrontViolation::kNothing);
}

/// With full corotation every leaf has its own rotation, unless it is about to be merged, and the mesh goes
/// down and up again.
TEST(RotationChanges, FullCorotationFollowsTheMesh) {
  sim::ModelParameters parameters = remeshing_bar();
  parameters.held = sim::HeldEnds::kBoth;
  parameters.remesh.rotation = RotationCriterion::kFull;
  const auto state = started<Ample>(compile_model(parameters));
  uint16_t most_leaves = 0;
  for (int i = 1; i <= 1200; ++i) {
    const double part = i <= 300 ? i / 300.0 : i <= 600 ? 1.0 : i <= 900 ? (900 - i) / 300.0 : 0.0;
    EXPECT_EQ(tick_once(*state, pulled(0.3 * part, 0.4 * part)).flags &
                  static_cast<uint32_t>(TickFlag::kRotationBudget),
              0u);
    most_leaves = std::max(most_leaves, state->forest.leaf_count);
    if (i % 10 == 0) {
      ASSERT_NO_FATAL_FAILURE(expect_whole(*state));
    }
    if (i == 600) {
      settle(*state, pulled(0.3, 0.4), 200, 3000);
      for (uint32_t k = 0; k < state->front.groups.used(); ++k) {
        const uint16_t group = state->front.groups.live(k);
        if (state->forest.tet[state->front.tet[group]].is_leaf()) continue;
        ASSERT_EQ(state->front.leaves[group].count, 2);
        for (const uint32_t which : {0u, 1u}) {
          const uint16_t child = state->forest.child(state->front.tet[group], which);
          EXPECT_EQ(state->urgencies.of[state->forest.tet[child].link()], Urgencies<Ample>::kCalm);
        }
      }
    }
  }
  settle(*state, pulled(0.0), 300, 4000);
  std::printf("at most %u leaves, %u merged\n", unsigned{most_leaves}, state->remesh.merged);
  EXPECT_GT(most_leaves, 18u << 3);
  EXPECT_EQ(state->forest.leaf_count, 18u << 2);
  EXPECT_EQ(state->front.groups.used(), 18u << 2);
}

/// Also where nothing turns at all, and a misfit is nothing.
TEST(RotationChanges, FullCorotationSplitsGroupsOfABodyAtRest) {
  sim::ModelParameters parameters = remeshing_bar();
  parameters.remesh.rotation = RotationCriterion::kFull;
  parameters.held = sim::HeldEnds::kBoth;
  const auto state = started<Ample>(compile_model(parameters));
  TickInput input = input_at_rest();
  input.tool = fixed_vector<Position>(Eigen::Vector3d(0.5, 0.5, 0.5));
  input.close_grasp = true;  // leaves at the grasped node go to their finest level
  settle(*state, input, 100, 3000);
  EXPECT_GT(state->remesh.bisected, 20u);
  for (uint32_t i = 0; i < state->forest.leaf_count; ++i) {
    const Leaf& leaf = state->forest.leaf[i];
    if (leaf.level() > 3) {
      EXPECT_EQ(state->front.tet[leaf.group], leaf.tet);
    }
  }
}

}  // namespace
}  // namespace palpate::test
