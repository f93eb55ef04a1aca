// The splits of the mesh. The most urgent leaves are split, each with its whole patch, coarser
// patches first; a leaf that has to wait keeps its urgency, which grows with every renewal, so none starves.
// One whose patch has to wait for a tether does not hold the others up: it is passed over.
#pragma once

#include "palpate/remesh/mesh_turn.hpp"

namespace palpate {

template <class Profile, class Body>
class PatchSplits {
 public:
  explicit PatchSplits(MeshTurn<Profile, Body>& turn)
      : turn_(turn), forest_(turn.forest), urgencies_(turn.urgencies) {}

  /// For the next turn of the mesh.
  void choose_most_urgent() {
    urgencies_.waiting = find_most_urgent(
        forest_, urgencies_, [this](const Leaf& leaf) { return turn_.tethered(refinement_edge(leaf)); },
        urgencies_.chosen);
  }

  /// A merge since then may have moved a leaf, which waits for another turn.
  void split_chosen() {
    const MostUrgent<Profile>& chosen = urgencies_.chosen;
    SplitBudget left{
        bounded_total<kSteps>(StepsTotal{}), bounded_total<Profile::kPatches>(SplitsTotal{}), {}};
    for (const uint32_t i : bounded<kLooks>(chosen.count(), [] {})) {
      if (left.patches.left() == 0) break;
      const uint16_t leaf = chosen.leaf(i);
      if (urgencies_.of[leaf] < Urgency::kWanted) continue;  // split by an earlier patch
      urgencies_.split_at = static_cast<uint16_t>(leaf / Urgency::kBlock + 1);
      if (!split_towards(leaf, left)) break;
    }
    const Waiting& waiting = urgencies_.waiting;
    turn_.counters.leaves_waiting = static_cast<uint16_t>(waiting.all);
    if (waiting.all > waiting.blocked && turn_.flags == 0) turn_.flag(RemeshFlag::kPatchBudget);
  }

 private:
  using Urgency = Urgencies<Profile>;
  static constexpr uint32_t kLooks = MostUrgent<Profile>::kLooks;
  static constexpr uint32_t kSteps = kLooks + Profile::kMaxLevel;
  struct StepsTotal {};
  struct SplitsTotal {};
  struct SplitTets {};
  using TetTotals = PatchTotals<Profile::kTetsSplit, SplitTets>;
  /// Of a turn: patches that are looked at on the way to those that are ready, and those that are bisected.
  struct SplitBudget {
    decltype(bounded_total<kSteps>(StepsTotal{})) steps;
    decltype(bounded_total<Profile::kPatches>(SplitsTotal{})) patches;
    TetTotals tets;
  };

  /// Splits the patch of a leaf, or the coarser one in its way. False when nothing more can be split now.
  bool split_towards(uint16_t leaf, SplitBudget& left) {
    Patch patch{};
    const MeshStatus found = find_ready_patch(forest_, forest_.leaf[leaf].tet, patch, left.steps);
    if (found == MeshStatus::kNotReady) return false;
    if (found != MeshStatus::kDone || !stays_within_levels(patch)) {
      urgencies_.of[leaf] = Urgency::kBarred;
      --urgencies_.waiting.all;
      return true;
    }
    const EdgeEnds ends = refinement_edge(forest_.leaf_of(patch.tet[0]));
    if (turn_.is_tethered(ends)) {
      urgencies_.of[leaf] |= Urgency::kAsleep;
      ++urgencies_.waiting.blocked;
      return true;
    }
    if (patch.count > left.tets.left()) return false;
    if (turn_.tethers.is_full()) return turn_.refuse(RemeshFlag::kTethers);
    bool is_split = false;
    for ([[maybe_unused]] const uint32_t once : left.patches.take(0, 1)) {
      is_split = split(patch, ends, left.tets);
    }
    return is_split;
  }

  /// Also a coarser patch in a leaf's way, perhaps of another region, must not pass its region's finest
  /// level.
  [[nodiscard]] bool stays_within_levels(const Patch& patch) const {
    bool stays = true;
    for (const uint32_t i : bounded<kMaxPatch>(patch.count, [] {})) {
      const Leaf& leaf = forest_.leaf_of(patch.tet[i]);
      stays = all_of(stays, leaf.level() < turn_.rules.levels[leaf.region()].most);
    }
    return stays;
  }

  bool split(const Patch& patch, const EdgeEnds& ends, TetTotals& tets) {
    switch (bisect(forest_, patch, tets)) {
      case MeshStatus::kDone:
        after_split(patch, ends, tets);
        return true;
      case MeshStatus::kNodesFull:
        return turn_.refuse(RemeshFlag::kNodes);
      default:
        return turn_.refuse(RemeshFlag::kLeaves);
    }
  }

  /// Of two children the first has their parent's place, and its urgency till now.
  void after_split(const Patch& patch, const EdgeEnds& ends, TetTotals& tets) {
    for (const uint32_t i : tets.noted.take(0, patch.count)) {
      const uint16_t leaf = turn_.place_of(forest_.child(patch.tet[i], 0));
      const uint8_t urgency = urgencies_.of[leaf];
      urgencies_.waiting.all -= urgency >= Urgency::kWanted ? 1u : 0u;
      urgencies_.waiting.blocked -= urgency > Urgency::kMost ? 1u : 0u;
      urgencies_.of[leaf] = Urgency::kNeutral;
      ++turn_.front.leaves[forest_.leaf[leaf].group].count;
    }
    const uint16_t middle = middle_node(forest_.leaf_of(forest_.child(patch.tet[0], 0)));
    turn_.body.added(middle, ends);
    if (turn_.body.is_free(middle)) turn_.tether(middle, ends, patch.tet[0], TetherKind::kRelease);
    turn_.counters.bisected += patch.count;
    turn_.changed = true;
  }

  MeshTurn<Profile, Body>& turn_;
  Forest<Profile>& forest_;
  Urgencies<Profile>& urgencies_;
};

}  // namespace palpate
