// Fills the pools: the mesh grows patch by patch until no patch fits, the rotation front group by group. With
// the core's own functions, so every mesh and every front is one that ticks could have come to.
#pragma once

#include "body.hpp"
#include "palpate/firmware/cycle_state.hpp"

namespace palpate::worst_case {

using CoreState = State<Profile>;
using TheForest = Forest<Profile>;

/// What a tick finds when it wants to split a leaf, and what looking costs.
struct Descent {
  MeshStatus status = MeshStatus::kNotReady;
  Patch patch{};
  uint32_t looks = 0;  // at leaves
  uint32_t steps = 0;  // from one to a coarser one, and the last
  bool is_within_levels = true;
};

inline Descent descend(const CoreState& state, uint16_t wanted) {
  const TheForest& forest = state.forest;
  Descent descent;
  for (uint32_t step = 0; step <= Profile::kMaxLevel; ++step) {
    descent.status = find_patch(forest, wanted, descent.patch);
    descent.looks += 1 + descent.patch.count;
    ++descent.steps;
    if (descent.status != MeshStatus::kNotReady) break;
    wanted = descent.patch.blocker;
  }
  if (descent.status != MeshStatus::kDone) return descent;
  for (uint32_t i = 0; i < descent.patch.count; ++i) {
    const Leaf& leaf = forest.leaf_of(descent.patch.tet[i]);
    if (leaf.level() >= state.model.remesh.stretch.levels[leaf.region()].most)
      descent.is_within_levels = false;
  }
  return descent;
}

class MeshGrowth {
 public:
  MeshGrowth(CoreState& state, const Scene& scene, Draw& draw)
      : state_(state), forest_(state.forest), scene_(scene), draw_(draw) {}

  /// Until so many draws in a row did not fit.
  void run() {
    constexpr uint32_t kMostMisses = 60;
    for (uint32_t misses = 0; misses < kMostMisses && forest_.leaf_count < scene_.most_leaves; ++misses) {
      Patch patch{};
      if (draw_patch(patch) && bisect(forest_, patch) == MeshStatus::kDone) misses = 0;
    }
    count_and_index_groups(forest_, state_.front);
  }

 private:
  /// Of some patches drawn, the one after which leaves and nodes run out most nearly together.
  bool draw_patch(Patch& patch) {
    constexpr uint32_t kDraws = 48;
    const auto leaves = static_cast<int32_t>(Profile::kLeaves - forest_.leaf_count);
    const auto nodes = static_cast<int32_t>(Profile::kNodes - forest_.nodes.used());
    int32_t least = 0x7fffffff;
    for (uint32_t i = 0; i < kDraws; ++i) {
      const Descent descent = descend(state_, forest_.leaf[draw_.below(forest_.leaf_count)].tet);
      if (descent.status != MeshStatus::kDone || !descent.is_within_levels) continue;
      const auto count = static_cast<int32_t>(descent.patch.count);
      if (count > leaves || nodes == 0) continue;
      int32_t cost = count * nodes - leaves;
      cost = cost < 0 ? -cost : cost;
      const uint8_t level = forest_.leaf_of(descent.patch.tet[0]).level();
      if (scene_.keeps_type1 && type_of_level(level) == TetType::kType1) cost += 8 * nodes;
      if (scene_.is_deep) cost -= nodes * level;
      if (cost < least) patch = descent.patch;
      if (cost < least) least = cost;
    }
    return least != 0x7fffffff;
  }

  CoreState& state_;
  TheForest& forest_;
  const Scene& scene_;
  Draw& draw_;
};

/// One that can be split, or kNone.
inline uint16_t draw_group(const CoreState& state, Front which, Draw& draw) {
  constexpr uint32_t kDraws = 16;
  const auto& front = state.front;
  const auto size_of = [&](uint16_t group) -> uint32_t {
    return which == Front::kUneven ? front.leaves[group].count : state.forest.level_of(front.tet[group]);
  };
  uint16_t best = kNone;
  for (uint32_t i = 0; i < kDraws && (which != Front::kAny || best == kNone); ++i) {
    const uint16_t group = front.groups.live(draw.below(front.groups.used()));
    if (state.forest.tet[front.tet[group]].is_leaf()) continue;
    if (best == kNone || size_of(group) < size_of(best)) best = group;
  }
  return best;
}

/// Groups of the front are split until so many are in use.
inline void split_groups(CoreState& state, const Scene& scene, Draw& draw) {
  auto& front = state.front;
  count_and_index_groups(state.forest, front);
  constexpr uint32_t kMostMisses = 20;
  for (uint32_t misses = 0; misses < kMostMisses && front.groups.used() < scene.most_groups; ++misses) {
    const uint16_t group = draw_group(state, scene.front, draw);
    if (group == kNone) continue;
    auto steps = bounded_total<Profile::kLeaves>([] {});
    if (split_group(state.forest, front, group, steps) == kNone) return;
    count_and_index_groups(state.forest, front);
    misses = 0;
  }
}

}  // namespace palpate::worst_case
