// Each pool and budget too small on purpose: a flag names it, the simulation goes on whole, and what was
// refused is made up for when the load falls.
#include <gtest/gtest.h>

#include <ostream>

#include "support/remeshing.hpp"

namespace palpate::test {
namespace {

struct Plenty : TestProfile<1152, 512, 6> {
  static constexpr uint16_t kGroups = 1152;
  static constexpr uint32_t kPatches = 8;
  static constexpr uint32_t kTetsSplit = 64;
  static constexpr uint32_t kTetsMerged = 64;
  static constexpr uint32_t kRotationChanges = 200;
  static constexpr uint16_t kTethers = 300;
};
struct FewLeaves : Plenty {
  static constexpr uint16_t kLeaves = 200;
};
struct FewNodes : Plenty {
  static constexpr uint16_t kNodes = 70;
};
struct FewGroups : Plenty {
  static constexpr uint16_t kGroups = 24;
};
struct FewTethers : Plenty {
  static constexpr uint16_t kTethers = 2;
};
struct FewPatches : Plenty {
  static constexpr uint32_t kPatches = 1;
  static constexpr uint32_t kTetsSplit = 8;
  static constexpr uint32_t kTetsMerged = 8;
};
struct FewRotationChanges : Plenty {
  static constexpr uint32_t kRotationChanges = 1;
};

sim::ModelParameters twisted_bar() {
  sim::ModelParameters parameters = remeshing_bar();
  parameters.held = sim::HeldEnds::kBoth;
  return parameters;
}

TickInput load(double part) { return pulled(0.35 * part, 0.9 * part, 0.0); }

/// Loads the bar for 600 ticks and takes the load away. Returns the flags of all ticks.
template <class Profile>
uint32_t load_and_unload(State<Profile>& state, uint16_t& most_leaves) {
  uint32_t flags = 0;
  for (int i = 1; i <= 1200; ++i) {
    const double part = i <= 300 ? i / 300.0 : i <= 600 ? 1.0 : i <= 900 ? (900 - i) / 300.0 : 0.0;
    flags |= tick_once(state, load(part)).flags;
    most_leaves = std::max(most_leaves, state.forest.leaf_count);
    if (i % 20 == 0) expect_whole(state);
    if (testing::Test::HasFatalFailure()) break;
  }
  return flags;
}

constexpr uint32_t kAllWaiting = 0x3f * static_cast<uint32_t>(TickFlag::kPatchBudget);

/// `named`: what runs out. Others may wait with it, but nothing is named that is plentiful.
template <class Profile>
void expect_exhausted(TickFlag named, uint32_t also = 0) {
  const auto state = started<Profile>(compile_model(twisted_bar()));
  uint16_t most_leaves = 0;
  const uint32_t flags = load_and_unload(*state, most_leaves);
  std::printf("flags %03x, at most %u leaves, %u of %u groups, %u of %u nodes, %u of %u tethers\n", flags,
              unsigned{most_leaves}, unsigned{state->front.groups.counters().peak},
              unsigned{Profile::kGroups}, unsigned{state->forest.nodes.counters().peak},
              unsigned{Profile::kNodes}, unsigned{state->tethers.peak}, unsigned{Profile::kTethers});
  EXPECT_NE(flags & static_cast<uint32_t>(named), 0u);
  EXPECT_EQ(flags & kAllWaiting & ~(static_cast<uint32_t>(named) | also), 0u);
  // It catches up: unloaded and settled, the mesh is as coarse as it may be, and nobody waits.
  settle(*state, load(0.0), 300, 4000);
  const TickOutput output = tick_once(*state, load(0.0));
  EXPECT_EQ(output.flags & kAllWaiting, 0u);
  EXPECT_EQ(state->remesh.leaves_waiting + state->remesh.groups_waiting, 0);
  EXPECT_EQ(state->front.groups.used(), 18u);
  EXPECT_EQ(state->forest.leaf_count, 18u << 2);
  expect_whole(*state);
}

constexpr uint32_t kPatch = static_cast<uint32_t>(TickFlag::kPatchBudget);

TEST(RemeshExhaustion, OfLeaves) { expect_exhausted<FewLeaves>(TickFlag::kLeavesFull, kPatch); }
TEST(RemeshExhaustion, OfNodes) { expect_exhausted<FewNodes>(TickFlag::kNodesFull, kPatch); }
TEST(RemeshExhaustion, OfGroups) { expect_exhausted<FewGroups>(TickFlag::kGroupsFull, kPatch); }
TEST(RemeshExhaustion, OfTethers) { expect_exhausted<FewTethers>(TickFlag::kTethersFull, kPatch); }
TEST(RemeshExhaustion, OfThePatchBudget) { expect_exhausted<FewPatches>(TickFlag::kPatchBudget); }
TEST(RemeshExhaustion, OfTheRotationBudget) {
  expect_exhausted<FewRotationChanges>(TickFlag::kRotationBudget, kPatch);
}

/// While the load falls and no group waits to be split, what waits are joins: these are flagged too.
TEST(RemeshExhaustion, OfTheRotationBudgetByJoinsAlone) {
  const auto state = started<FewRotationChanges>(compile_model(twisted_bar()));
  for (int i = 1; i <= 600; ++i) tick_once(*state, load(std::min(1.0, i / 300.0)));
  settle(*state, load(1.0), 300, 4000);
  ASSERT_EQ(tick_once(*state, load(1.0)).flags & static_cast<uint32_t>(TickFlag::kRotationBudget), 0u);
  uint32_t flagged = 0;
  for (int i = 1; i <= 600; ++i) {
    const TickOutput output = tick_once(*state, load(std::max(0.0, 1.0 - i / 300.0)));
    if (state->remesh.groups_waiting == 0 && has(output, TickFlag::kRotationBudget)) ++flagged;
  }
  EXPECT_GT(flagged, 20u);
  settle(*state, load(0.0), 300, 4000);
  EXPECT_EQ(tick_once(*state, load(0.0)).flags & kAllWaiting, 0u);
}

/// With everything plentiful and the load kept, nobody waits in the end, with any criterion.
TEST(RemeshExhaustion, IsOverWhenThereIsRoom) {
  for (const RotationCriterion criterion : {RotationCriterion::kMisfit, RotationCriterion::kSiblings}) {
    for (const StretchCriterion stretch :
         {StretchCriterion::kSixEdges, StretchCriterion::kLongestEdge, StretchCriterion::kStrainJump}) {
      sim::ModelParameters parameters = twisted_bar();
      parameters.remesh.rotation = criterion;
      parameters.remesh.stretch = stretch;
      parameters.remesh.stretch_split = stretch == StretchCriterion::kStrainJump ? 0.1 : 0.06;
      const auto state = started<Plenty>(compile_model(parameters));
      for (int i = 1; i <= 300; ++i) tick_once(*state, load(i / 600.0));
      settle(*state, load(0.5), 300, 4000);
      EXPECT_EQ(tick_once(*state, load(0.5)).flags, 0u);
      std::printf("%u leaves, %u groups\n", unsigned{state->forest.leaf_count},
                  unsigned{state->front.groups.used()});
      EXPECT_GT(state->front.groups.used(), 18u);
      expect_whole(*state);
    }
  }
}

/// At the peak somebody has to wait. What was refused is done as soon as there is room: nobody waits any more
/// when the load has fallen to `kept`, although the rotation front is still wanted finer than at rest.
template <class Profile>
void expect_made_up_for(double kept) {
  const auto state = started<Profile>(compile_model(twisted_bar()));
  uint32_t waited = 0;
  for (int i = 1; i <= 600; ++i) {
    tick_once(*state, load(std::min(1.0, i / 300.0)));
    waited = std::max<uint32_t>(waited, state->remesh.leaves_waiting + state->remesh.groups_waiting);
  }
  EXPECT_GT(waited, 0u);
  for (int i = 1; i <= 300; ++i) tick_once(*state, load(1.0 - (1.0 - kept) * i / 300.0));
  const uint32_t last = settle(*state, load(kept), 300, 4000);
  std::printf("at most %u waited; at load %.2f nobody after %u ticks, with %u leaves, %u groups\n", waited,
              kept, last, unsigned{state->forest.leaf_count}, unsigned{state->front.groups.used()});
  EXPECT_LT(last, 3700u);
  EXPECT_EQ(tick_once(*state, load(kept)).flags & kAllWaiting, 0u);
  EXPECT_EQ(state->remesh.leaves_waiting, 0);
  EXPECT_EQ(state->remesh.groups_waiting, 0);
  EXPECT_GT(state->front.groups.used(), 18u);
  expect_whole(*state);
}

TEST(RemeshExhaustion, WhatLeavesRefusedIsMadeUpFor) { expect_made_up_for<FewLeaves>(0.25); }
TEST(RemeshExhaustion, WhatNodesRefusedIsMadeUpFor) { expect_made_up_for<FewNodes>(0.25); }
TEST(RemeshExhaustion, WhatGroupsRefusedIsMadeUpFor) { expect_made_up_for<FewGroups>(0.15); }
// These only delay: even the whole load is served in the end.
TEST(RemeshExhaustion, WhatTethersRefusedIsMadeUpFor) { expect_made_up_for<FewTethers>(1.0); }
TEST(RemeshExhaustion, WhatThePatchBudgetRefusedIsMadeUpFor) { expect_made_up_for<FewPatches>(1.0); }
TEST(RemeshExhaustion, WhatTheRotationBudgetRefusedIsMadeUpFor) {
  expect_made_up_for<FewRotationChanges>(1.0);
}

}  // namespace
}  // namespace palpate::test
