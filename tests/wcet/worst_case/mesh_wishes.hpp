// What changes of the mesh the next tick is to look at: tethers, some of which end with a merge, and
// urgencies whose search and whose patches cost most.
#pragma once

#include "mesh_growth.hpp"

namespace palpate::worst_case {

class MeshWishes {
 public:
  MeshWishes(CoreState& state, Draw& draw) : state_(state), forest_(state.forest), draw_(draw) {}

  void make() {
    state_.tethers.clear();
    state_.urgencies.clear();
    state_.urgencies.merge_at = static_cast<uint16_t>(draw_.below(forest_.leaf_count));
    add_ending_tethers();
    add_tethers();
    want_all_leaves();
    calm_merges();
    want_worst_patches();
    meet_worst_last();
    state_.urgencies.sweep_at = inmost_window();
  }

 private:
  static constexpr uint32_t kLooks = 2 * Profile::kPatches;

  struct Merge {
    uint16_t middle = kNone;
    EdgeEnds ends{};
    Patch patch{};
  };

  /// Of a leaf's parent and those around the same edge. False when there is none.
  bool find(const Leaf& leaf, Merge& merge) const {
    if (leaf.level == 0 || find_merge(forest_, leaf.tet, merge.patch) != MeshStatus::kDone) return false;
    merge.middle = middle_node(leaf);
    merge.ends = restored_edge(forest_, merge.patch.tet[0]);
    return may_tether(merge.middle, merge.ends);
  }
  [[nodiscard]] bool may_tether(uint16_t middle, const EdgeEnds& ends) const {
    const Tethers<Profile>& tethers = state_.tethers;
    if (state_.solve.control[middle] != NodeControl::kFree || tethers.is_full()) return false;
    if (tethers.holds(middle) || tethers.holds(ends[0]) || tethers.holds(ends[1])) return false;
    for (uint32_t i = 0; i < tethers.count; ++i) {
      if (tethers.tether[i].end[0] == middle || tethers.tether[i].end[1] == middle) return false;
    }
    return true;
  }
  /// Whether no child is a rotation tet.
  [[nodiscard]] bool is_below_front(const Patch& patch) const {
    for (uint32_t i = 0; i < patch.count; ++i) {
      for (uint32_t which = 0; which < 2; ++which) {
        const Leaf& leaf = forest_.leaf_of(forest_.child(patch.tet[i], which));
        if (forest_.tet[state_.front.tet[leaf.group]].level >= leaf.level) return false;
      }
    }
    return true;
  }
  void tether(const Merge& merge, uint32_t ticks) {
    const auto left = static_cast<uint8_t>(ticks);
    state_.tethers.add(Tether{merge.middle, merge.ends, merge.patch.tet[0], left, TetherKind::kDraw, 0});
  }

  /// As many as a tick looks at, the largest patches. The first ones will not be calm.
  void add_ending_tethers() {
    for (uint32_t size = kMaxPatch; size > 0; --size) {
      for (uint32_t i = 0; i < forest_.leaf_count && state_.tethers.count < kLooks; ++i) {
        Merge merge;
        if (!find(forest_.leaf[i], merge) || merge.patch.count != size || !is_below_front(merge.patch))
          continue;
        tether(merge, 1);
      }
    }
    ending_ = state_.tethers.count;
  }
  void add_tethers() {
    const uint32_t start = draw_.below(forest_.leaf_count);
    for (uint32_t i = 0; i < forest_.leaf_count; ++i) {
      Merge merge;
      if (find(forest_.leaf[(start + i) % forest_.leaf_count], merge)) tether(merge, 2 + draw_.below(30));
    }
  }

  void want_all_leaves() {
    for (uint32_t i = 0; i < forest_.leaf_count; ++i)
      urgency(forest_.leaf[i].tet) = Urgencies<Profile>::kWanted;
  }

  /// The search begins behind one of the most urgent leaves, where it is longest until it meets another. On
  /// its way every leaf is at least as urgent as those before.
  void meet_worst_last() {
    constexpr uint32_t kLevels = Urgencies<Profile>::kMost - Urgencies<Profile>::kWanted;
    const uint32_t count = forest_.leaf_count;
    uint32_t longest = 0;
    uint32_t since = 0;  // the last of the most urgent
    for (uint32_t i = 0; i < 2 * count; ++i, ++since) {
      if (urgency(forest_.leaf[i % count].tet) != Urgencies<Profile>::kMost) continue;
      if (since > longest)
        state_.urgencies.split_at = static_cast<uint16_t>((i + 2 * count + 1 - since) % count);
      if (since > longest) longest = since;
      since = 0;
    }
    if (longest == 0) longest = count;
    for (uint32_t i = 0; i < count; ++i) {
      uint8_t& of = urgency(forest_.leaf[(state_.urgencies.split_at + i) % count].tet);
      const uint32_t level = i < longest ? i * kLevels / longest : kLevels - 1;
      if (of == Urgencies<Profile>::kWanted) of = static_cast<uint8_t>(Urgencies<Profile>::kWanted + level);
    }
  }
  /// Half of the patches whose tethers end may be merged, as far as the budget goes; some others are calm.
  void calm_merges() {
    uint32_t tets = 0;
    for (uint32_t i = ending_ / 2; i < ending_; ++i) {
      Patch patch{};
      const uint16_t child = forest_.child(state_.tethers.tether[i].tet, 0);
      if (find_merge(forest_, child, patch) != MeshStatus::kDone) continue;
      calm(patch);
      if (tets + patch.count > Profile::kTetsMerged) continue;
      tets += patch.count;
    }
    room_ = Profile::kLeaves - forest_.leaf_count + tets;
    uint32_t others = 0;
    for (uint32_t i = 0; i < forest_.leaf_count && others < kLooks; ++i) {
      const Leaf& leaf = forest_.leaf[(state_.urgencies.merge_at + i) % forest_.leaf_count];
      Merge merge;
      if (leaf.level == 0 || state_.tethers.holds(middle_node(leaf)) || urgency(leaf.tet) < 3) continue;
      if (find_merge(forest_, leaf.tet, merge.patch) != MeshStatus::kDone || merge.patch.count < 6) continue;
      calm(merge.patch);
      ++others;
    }
  }
  void calm(const Patch& patch) {
    for (uint32_t k = 0; k < patch.count; ++k) {
      urgency(forest_.child(patch.tet[k], 0)) = Urgencies<Profile>::kCalm;
      urgency(forest_.child(patch.tet[k], 1)) = Urgencies<Profile>::kCalm;
    }
  }

  /// The longest descents that end at a bar, then the one to the largest patch that fits.
  void want_worst_patches() {
    for (uint32_t look = 0; look + 1 < MostUrgent<Profile>::kLooks; ++look)
      want_worst(look + 1 < kBarredLooks);
    want_worst(false);
  }
  static constexpr uint32_t kBarredLooks = MostUrgent<Profile>::kLooks - Profile::kPatches + 1;
  void want_worst(bool is_to_fail) {
    uint32_t most = 0;
    uint16_t worst = kNone;
    for (uint32_t i = 0; i < forest_.leaf_count; ++i) {
      const Leaf& leaf = forest_.leaf[i];
      if (urgency(leaf.tet) < Urgencies<Profile>::kWanted || urgency(leaf.tet) == Urgencies<Profile>::kMost)
        continue;
      if (is_tethered(refinement_edge(leaf))) continue;
      const Descent descent = descend(state_, leaf.tet);
      const bool fails = descent.status != MeshStatus::kDone || !descent.is_within_levels ||
                         is_tethered(refinement_edge(forest_.leaf_of(descent.patch.tet[0])));
      if (fails != is_to_fail || (!fails && descent.patch.count > room_)) continue;
      const uint32_t cost = descent.looks + (is_to_fail ? 0 : 8 * descent.patch.count);
      if (cost <= most) continue;
      most = cost;
      worst = leaf.tet;
    }
    if (worst != kNone) urgency(worst) = Urgencies<Profile>::kMost;
  }
  [[nodiscard]] bool is_tethered(const EdgeEnds& ends) const {
    return state_.tethers.holds(ends[0]) || state_.tethers.holds(ends[1]);
  }

  /// Where the slice of leaves that are measured in a tick has most neighbours.
  [[nodiscard]] uint16_t inmost_window() const {
    constexpr uint32_t kSlice = Urgencies<Profile>::kSlice;
    uint32_t best = 0;
    uint32_t most = 0;
    for (uint32_t first = 0; first + kSlice <= forest_.leaf_count; first += 4) {
      uint32_t neighbours = 0;
      for (uint32_t i = first; i < first + kSlice; ++i) {
        for (const uint16_t neighbour : forest_.leaf[i].neighbour) neighbours += neighbour != kNone ? 1u : 0u;
      }
      if (neighbours > most) best = first;
      if (neighbours > most) most = neighbours;
    }
    return static_cast<uint16_t>(best);
  }

  uint8_t& urgency(uint16_t tet) { return state_.urgencies.of[tet]; }

  CoreState& state_;
  TheForest& forest_;
  Draw& draw_;
  uint32_t ending_ = 0;  // tethers, the first ones
  uint32_t room_ = 0;    // for leaves, after the merges
};

}  // namespace palpate::worst_case
