// What changes of the mesh the next tick is to look at: tethers, some of which end with a merge, and
// urgencies whose search and whose patches cost most.
#pragma once

#include "mesh_growth.hpp"

namespace palpate::worst_case {

class MeshWishes {
 public:
  MeshWishes(CoreState& state, const Scene& scene, Draw& draw)
      : state_(state), forest_(state.forest), scene_(scene), draw_(draw) {}

  void make() {
    state_.tethers.clear();
    state_.urgencies.clear();
    state_.urgencies.merge_at = static_cast<uint16_t>(draw_.below(forest_.leaf_count));
    state_.urgencies.sweep_at = static_cast<uint16_t>(draw_.below(forest_.leaf_count));
    want_all_leaves();
    add_ending_tethers();
    const uint32_t merges = calm_ending();
    // Those of merges make room in the turn of the mesh for the patches that are split.
    const uint32_t freed = scene_.slot == Slot::kMesh ? merges : 0;
    add_tethers(scene_.wishes_any ? Profile::kTethers : Profile::kTethers + freed - Profile::kPatches);
    calm_others();
    want_worst_patches();
    meet_worst_last();
    if (scene_.slot == Slot::kMesh) choose_most_urgent();
  }

 private:
  using Urgency = Urgencies<Profile>;
  static constexpr uint32_t kLooks = 2 * Profile::kPatches;

  struct Merge {
    uint16_t middle = kNone;
    EdgeEnds ends{};
    Patch patch{};
  };

  /// Of a leaf's parent and those around the same edge. False when there is none.
  bool find(const Leaf& leaf, Merge& merge) const {
    if (leaf.level() == 0 || find_merge(forest_, leaf.tet, merge.patch) != MeshStatus::kDone) return false;
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
        if (forest_.level_of(state_.front.tet[leaf.group]) >= leaf.level()) return false;
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
  /// With room left for the middle nodes of the patches that will be split or drawn.
  void add_tethers(uint32_t most) {
    const uint32_t start = draw_.below(forest_.leaf_count);
    for (uint32_t i = 0; i < forest_.leaf_count && state_.tethers.count < most; ++i) {
      Merge merge;
      if (find(forest_.leaf[(start + i) % forest_.leaf_count], merge)) tether(merge, 2 + draw_.below(30));
    }
  }

  void want_all_leaves() {
    for (uint32_t i = 0; i < forest_.leaf_count; ++i) urgency(forest_.leaf[i].tet) = Urgency::kWanted;
  }

  /// The search begins behind some of the most urgent leaves, where it is longest until it meets others. On
  /// its way each leaf is more urgent than those before, until there are only offers left for the most urgent
  /// ones, or blocked by a tether, which is seen when it is looked at.
  void meet_worst_last() {
    constexpr uint32_t kOffers = 7 * MostUrgent<Profile>::kLooks;
    static_assert(Urgency::kWanted + kOffers < kLastOnes);
    constexpr uint32_t kBlocks = Urgency::kBlocks;
    constexpr uint32_t kBlock = Urgency::kBlock;
    uint32_t longest = 0;
    uint32_t since = 0;  // the last of the most urgent
    for (uint32_t i = 0; i < 2 * kBlocks; ++i, ++since) {
      if (!has_last_ones(i % kBlocks)) continue;
      if (since > longest)
        state_.urgencies.split_at = static_cast<uint16_t>((i + 2 * kBlocks + 1 - since) % kBlocks);
      if (since > longest) longest = since;
      since = 0;
    }
    uint32_t offers = 0;
    for (uint32_t i = 0; i < kBlock * kBlocks; ++i) {
      const uint32_t leaf = (kBlock * state_.urgencies.split_at + i) % (kBlock * kBlocks);
      uint8_t& of = state_.urgencies.of[leaf];
      if (of != Urgency::kWanted) continue;
      if (is_tethered(refinement_edge(forest_.leaf[leaf]))) {
        of = Urgency::kMost;
      } else if (offers < kOffers) {
        of = static_cast<uint8_t>(Urgency::kWanted + offers++);
      }
    }
  }
  /// As the tick before would have.
  void choose_most_urgent() {
    Urgencies<Profile>& urgencies = state_.urgencies;
    const auto is_blocked = [this](const Leaf& leaf) { return is_tethered(refinement_edge(leaf)) ? 1u : 0u; };
    urgencies.waiting = find_most_urgent(forest_, urgencies, is_blocked, urgencies.chosen);
  }
  /// Half of the patches whose tethers end may be merged, as far as the budget goes. Returns how many.
  uint32_t calm_ending() {
    uint32_t merges = 0;
    uint32_t tets = 0;
    for (uint32_t i = ending_ / 2; i < ending_; ++i) {
      Patch patch{};
      const uint16_t child = forest_.child(state_.tethers.tether[i].tet, 0);
      if (find_merge(forest_, child, patch) != MeshStatus::kDone) continue;
      calm(patch);
      if (merges == Profile::kPatches || tets + patch.count > Profile::kTetsMerged) continue;
      tets += patch.count;
      ++merges;
    }
    room_ = Profile::kLeaves - forest_.leaf_count + tets;
    if (room_ > Profile::kTetsSplit) room_ = Profile::kTetsSplit;
    return merges;
  }
  /// Some that the tick may begin to draw.
  void calm_others() {
    uint32_t others = 0;
    for (uint32_t i = 0; i < forest_.leaf_count && others < kLooks; ++i) {
      const Leaf& leaf = forest_.leaf[(state_.urgencies.merge_at + i) % forest_.leaf_count];
      Merge merge;
      if (leaf.level() == 0 || state_.tethers.holds(middle_node(leaf)) ||
          urgency(leaf.tet) < Urgency::kWanted)
        continue;
      if (find_merge(forest_, leaf.tet, merge.patch) != MeshStatus::kDone) continue;
      if (scene_.wishes_any ? !is_below_front(merge.patch) : merge.patch.count < 6) continue;
      calm(merge.patch);
      ++others;
    }
  }
  void calm(const Patch& patch) {
    for (uint32_t k = 0; k < patch.count; ++k) {
      urgency(forest_.child(patch.tet[k], 0)) = Urgency::kCalm;
      urgency(forest_.child(patch.tet[k], 1)) = Urgency::kCalm;
    }
  }

  /// The longest descents that end at a bar, then those to the largest patches that fit. All share a total of
  /// steps.
  void want_worst_patches() {
    for (uint32_t look = 0; look < kFits; ++look) want_worst(false, kLastOnes, kPathSteps);
    steps_ -= steps_ < kFails ? 0 : kFails;
    for (uint32_t look = 0; look < kFails; ++look) want_worst(true, Urgency::kMost, steps_ + 1);
  }
  static constexpr uint32_t kFits = Profile::kPatches;
  static constexpr uint32_t kFails = MostUrgent<Profile>::kLooks - kFits;
  static constexpr uint8_t kLastOnes = Urgency::kMost - 1;  // as urgent as that or more
  static constexpr uint32_t kPathSteps = Profile::kMaxLevel + 1u;

  void want_worst(bool is_to_fail, uint8_t how_urgent, uint32_t most_steps) {
    uint32_t most = 0;
    uint32_t steps = 0;
    uint32_t count = 0;
    uint16_t worst = kNone;
    for (uint32_t i = 0; i < forest_.leaf_count; ++i) {
      const Leaf& leaf = forest_.leaf[i];
      if (urgency(leaf.tet) != Urgency::kWanted || is_tethered(refinement_edge(leaf))) continue;
      const Descent descent = descend(state_, leaf.tet);
      const bool waits = descent.status == MeshStatus::kDone && descent.is_within_levels &&
                         is_tethered(refinement_edge(forest_.leaf_of(descent.patch.tet[0])));
      const bool fails = waits || descent.status != MeshStatus::kDone || !descent.is_within_levels;
      if (scene_.wishes_any && fails && !waits && draw_.one_in(2)) continue;
      if (fails != is_to_fail || (descent.steps > most_steps && !scene_.wishes_any) ||
          (!fails && descent.patch.count > room_))
        continue;
      const uint32_t cost = descent.looks + (is_to_fail ? 0 : 8 * descent.patch.count);
      if (cost <= most) continue;
      most = cost;
      steps = descent.steps;
      count = descent.patch.count;
      worst = leaf.tet;
    }
    if (worst == kNone) return;
    urgency(worst) = how_urgent;
    if (!is_to_fail) room_ -= count;
    const uint32_t used = is_to_fail ? steps - 1 : steps;
    steps_ -= used < steps_ ? used : steps_;
  }
  [[nodiscard]] bool is_tethered(const EdgeEnds& ends) const {
    return state_.tethers.holds(ends[0]) || state_.tethers.holds(ends[1]);
  }

  [[nodiscard]] bool has_last_ones(uint32_t block) const {
    const uint8_t* const of = &state_.urgencies.of[Urgency::kBlock * block];
    return std::any_of(of, of + Urgency::kBlock, [](uint8_t urgency) { return urgency >= kLastOnes; });
  }
  uint8_t& urgency(uint16_t tet) { return state_.urgencies.of[forest_.tet[tet].link()]; }

  CoreState& state_;
  TheForest& forest_;
  const Scene& scene_;
  Draw& draw_;
  uint32_t ending_ = 0;                                                // tethers, the first ones
  uint32_t room_ = 0;                                                  // for leaves, after the merges
  uint32_t steps_ = MostUrgent<Profile>::kLooks + Profile::kMaxLevel;  // of all descents together
};

}  // namespace palpate::worst_case
