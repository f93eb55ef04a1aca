// Bodies whose two fronts move, and what they did in a tick.
#pragma once

#include <algorithm>
#include <set>
#include <tuple>

#include "palpate/mesh/front_patch.hpp"
#include "support/bodies.hpp"
#include "support/fronts.hpp"

namespace palpate::test {

/// The bar at level 3, damped so that it settles soon; leaves go to level 2 at rest and to level 5 where
/// edges are 5 percent longer.
inline sim::ModelParameters remeshing_bar() {
  sim::ModelParameters parameters;
  parameters.level = 3;
  parameters.substeps = 1;
  parameters.mass_damping_per_s = 20.0;
  parameters.regions[0] = {500.0, 0.45, 1000.0, 2, 5};
  parameters.remesh.stretch = StretchCriterion::kSixEdges;
  parameters.remesh.stretch_split = 0.05;
  return parameters;
}

/// The far end face pulled away by so many edges, and turned about the bar's axis and across it.
inline TickInput pulled(double edges, double twist = 0.0, double bend = 0.0) {
  TickInput input = input_at_rest();
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(twist, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(bend, Eigen::Vector3d::UnitY()))
          .toRotationMatrix();
  const Eigen::Vector3d end(0, 0, 1.5);
  input.hold_motion[1].rotation = fixed_matrix<RotationEntry>(turn);
  input.hold_motion[1].translation =
      fixed_vector<Position>(Eigen::Vector3d(end - turn * end + Eigen::Vector3d(0, 0, edges)));
  return input;
}

/// Whether all tets around one edge are on the front together or not at all: of a group's parent, which is
/// above the front, all that share its edge are.
template <class Profile>
bool conforms(const Forest<Profile>& forest, const RotationFront<Profile>& front) {
  for (uint32_t i = 0; i < front.groups.used(); ++i) {
    const uint16_t parent = forest.parent_of(front.tet[front.groups.live(i)]);
    if (parent == kNone) continue;
    FrontPatch patch{};
    if (find_front_patch(forest, front, parent, patch) != MeshStatus::kDone) return false;
    for (uint32_t k = 0; k < patch.count; ++k) {
      const uint16_t group = forest.leaf_of(first_leaf(forest, patch.tet[k])).group;
      if (front.tet[group] == patch.tet[k]) return false;
    }
  }
  return true;
}

/// Both fronts' turns, and what comes before and after the mesh's.
template <class Profile>
void change_fronts(State<Profile>& state) {
  change_front(state);
  judge_mesh(state);
  choose_for_mesh(state);
  change_mesh(state);
  draw_for_mesh(state);
}

/// Whether the tick before was the mesh's turn.
template <class Profile>
bool mesh_had_its_turn(const State<Profile>& state) {
  return state.tick > 0 && slot_of(state.tick - 1) == Slot::kMesh;
}

template <class Profile>
void expect_whole(const State<Profile>& state) {
  ASSERT_EQ(check_forest(state.forest, state.model.block), Violation::kNothing) << "tick " << state.tick;
  ASSERT_EQ(check_front(state.forest, state.front), FrontViolation::kNothing) << "tick " << state.tick;
  if (state.model.remesh.rotation.criterion != RotationCriterion::kMisfit) {
    ASSERT_TRUE(conforms(state.forest, state.front)) << "tick " << state.tick;
  }
  for (uint32_t i = 0; i < state.tethers.count; ++i) {
    const Tether& tether = state.tethers.tether[i];
    for (const uint16_t node : {tether.node, tether.end[0], tether.end[1]}) {
      ASSERT_TRUE(state.forest.nodes.is_live(node)) << "tick " << state.tick;
    }
    ASSERT_TRUE(state.tethers.holds(tether.node));
    ASSERT_FALSE(state.tethers.holds(tether.end[0]));
    ASSERT_FALSE(state.tethers.holds(tether.end[1]));
  }
  uint32_t held = 0;
  for (uint32_t node = 0; node < Profile::kNodes; ++node)
    held += state.tethers.holds(static_cast<uint16_t>(node)) ? 1u : 0u;
  ASSERT_EQ(held, state.tethers.count) << "tick " << state.tick;
  if (!mesh_had_its_turn(state)) return;
  uint32_t waiting = 0;
  for (uint32_t i = 0; i < state.forest.leaf_count; ++i)
    waiting += state.urgencies.of[i] >= Urgencies<Profile>::kWanted ? 1u : 0u;
  ASSERT_EQ(state.remesh.leaves_waiting, waiting) << "tick " << state.tick;
  for (uint32_t i = state.forest.leaf_count; i < state.urgencies.of.size(); ++i)
    ASSERT_EQ(state.urgencies.of[i], Urgencies<Profile>::kNeutral) << "tick " << state.tick;
}

/// What one tick changed.
struct Changes {
  uint32_t patches_split, patches_merged, tets_split, tets_merged, groups_split, joins_begun;
};

/// Remembers the fronts, to say after a tick what has changed.
template <class Profile>
class ChangeWatch {
 public:
  explicit ChangeWatch(const State<Profile>& state) : state_(state) { remember(); }

  Changes changes() {
    Changes made{};
    const auto nodes = live_nodes();
    for (const auto& node : nodes) made.patches_split += nodes_.count(node) == 0 ? 1u : 0u;
    for (const auto& node : nodes_) made.patches_merged += nodes.count(node) == 0 ? 1u : 0u;
    made.tets_split = state_.remesh.bisected - counters_.bisected;
    made.tets_merged = state_.remesh.merged - counters_.merged;
    made.groups_split = state_.remesh.groups_split - counters_.groups_split;
    for (const auto& pair : partners()) made.joins_begun += partners_.count(pair) == 0 ? 1u : 0u;
    remember();
    return made;
  }

 private:
  using Pair = std::pair<uint16_t, uint16_t>;
  using Place = std::tuple<int, int, int>;

  /// By their places at rest: a slot may be used again.
  std::set<Place> live_nodes() const {
    std::set<Place> nodes;
    for (uint32_t i = 0; i < state_.forest.nodes.used(); ++i) {
      const LatticePoint rest = state_.forest.node.rest[state_.forest.nodes.live(i)];
      nodes.emplace(rest.x, rest.y, rest.z);
    }
    return nodes;
  }
  /// First groups of pairs about to be joined, by their tets.
  std::set<Pair> partners() const {
    std::set<Pair> pairs;
    for (uint32_t i = 0; i < state_.front.groups.used(); ++i) {
      const uint16_t group = state_.front.groups.live(i);
      if (state_.front.partner[group] == kNone || is_second_of_pair(state_.front, group)) continue;
      pairs.emplace(state_.front.tet[group], state_.front.partner[group]);
    }
    return pairs;
  }
  void remember() {
    nodes_ = live_nodes();
    partners_ = partners();
    counters_ = state_.remesh;
  }

  const State<Profile>& state_;
  std::set<Place> nodes_;
  std::set<Pair> partners_;
  RemeshCounters counters_{};
};

inline bool has(const TickOutput& output, TickFlag flag) {
  return (output.flags & static_cast<uint32_t>(flag)) != 0;
}

/// Goes on until neither front has changed for `calm_ticks`. Returns the tick in which it last did, or
/// `limit`.
template <class Profile>
uint32_t settle(State<Profile>& state, const TickInput& input, uint32_t calm_ticks, uint32_t limit) {
  const auto count = [&] {
    const RemeshCounters& c = state.remesh;
    return uint64_t{c.bisected} + c.merged + c.groups_split + c.groups_joined;
  };
  uint64_t before = count();
  uint32_t last = 0;
  for (uint32_t i = 1; i <= limit; ++i) {
    tick_once(state, input);
    if (count() != before || state.tethers.count != 0) last = i;
    before = count();
    if (i - last >= calm_ticks) return last;
  }
  return limit;
}

}  // namespace palpate::test
