// The merges of a turn of the mesh, and their tethers. A calm patch is merged after its middle node was drawn
// to where its removal changes nothing; when the patch stirs meanwhile, the node is let go of again.
#pragma once

#include "palpate/remesh/mesh_turn.hpp"

namespace palpate {

template <class Profile, class Body>
class PatchMerges {
 public:
  explicit PatchMerges(MeshTurn<Profile, Body>& turn)
      : turn_(turn), forest_(turn.forest), tethers_(turn.tethers), urgencies_(turn.urgencies) {}

  /// A tick of all tethers. What is released moves freely from now on, and around what was drawn is merged.
  void end_tethers() {
    MergeBudget left{bounded_total<2 * Profile::kPatches>(LooksTotal{}),
                     bounded_total<Profile::kPatches>(MergesTotal{}),
                     {}};
    auto ends = bounded_total<kMostEnds>([] {});
    uint32_t at = 0;
    bool has_budget = true;
    bool have_to_wait = false;
    for ([[maybe_unused]] const uint32_t i : bounded<Profile::kTethers>(tethers_.count, [] {})) {
      Tether& tether = tethers_.tether[at];
      const bool is_taken = tether.node == turn_.pinned;  // by the tool: nothing else moves it
      const bool is_over = any_of(is_taken, tether.ticks_left <= 1);
      tether.ticks_left = static_cast<uint8_t>(tether.ticks_left - (is_over ? 0u : 1u));
      const bool is_merge = all_of(is_over, !is_taken, tether.kind == TetherKind::kDraw);
      const bool has_to_wait = all_of(is_merge, !has_budget);
      have_to_wait = any_of(have_to_wait, has_to_wait);
      ++at;  // it holds the node where it is, or now lets go of it
      if (!all_of(is_over, !has_to_wait, ends.left() != 0)) continue;
      for ([[maybe_unused]] const uint32_t end : ends.take(0, 1)) {
        const bool goes_on = is_merge && !merge_within(tether, left);
        has_budget = all_of(left.patches.left() != 0, left.looks.left() != 0);
        if (goes_on) continue;
        --at;
        tethers_.remove(at);
      }
    }
    if (have_to_wait) turn_.flag(RemeshFlag::kPatchBudget);
  }

  /// Starts to draw the middle nodes of calm patches.
  void draw_calm() {
    constexpr uint32_t kSlice = Urgencies<Profile>::kSlice;
    const uint32_t count = kSlice < forest_.leaf_count ? kSlice : forest_.leaf_count;
    auto looks = bounded_total<2 * Profile::kPatches>([] {});
    for ([[maybe_unused]] const uint32_t i : bounded<kSlice>(count, [] {})) {
      if (urgencies_.merge_at >= forest_.leaf_count) urgencies_.merge_at = 0;
      if (looks.left() == 0) return;
      const uint16_t at = urgencies_.merge_at;
      const Leaf& leaf = forest_.leaf[at];
      ++urgencies_.merge_at;
      if (urgencies_.of[at] != Urgency::kCalm || leaf.level() == 0) continue;
      for ([[maybe_unused]] const uint32_t look : looks.take(0, 1)) draw(leaf);
    }
  }

 private:
  using Urgency = Urgencies<Profile>;
  /// More cannot end in a turn: releases of as many patches as are split, and of as many draws as fail;
  /// draws that are looked at; and what the tool takes.
  static constexpr uint32_t kMostEnds = 5 * Profile::kPatches + 1;
  struct LooksTotal {};
  struct MergesTotal {};
  struct MergeTets {};
  using TetTotals = PatchTotals<Profile::kTetsMerged, MergeTets>;
  /// What ends in a turn: tethers whose patch is looked at, and patches that are merged.
  struct MergeBudget {
    decltype(bounded_total<2 * Profile::kPatches>(LooksTotal{})) looks;
    decltype(bounded_total<Profile::kPatches>(MergesTotal{})) patches;
    TetTotals tets;
  };

  PALPATE_NOINLINE bool merge_within(Tether& tether, MergeBudget& left) {
    bool is_merged = false;
    for ([[maybe_unused]] const uint32_t look : left.looks.take(0, 1)) is_merged = merge_at(tether, left);
    return is_merged;
  }

  /// Merges around a node that has been drawn. False, with the tether turned into a release, when the patch
  /// is no longer calm; false and as it was when the budget is used up.
  bool merge_at(Tether& tether, MergeBudget& left) {
    Patch patch{};
    if (!find_patch_around(tether, patch) || !may_merge(patch, Urgency::kNeutral) ||
        restores_above(turn_.rules.split_above, patch, tether.end)) {
      tether.kind = TetherKind::kRelease;
      tether.ticks_left = kTetherTicks;
      return false;
    }
    if (patch.count > left.tets.left()) return turn_.refuse(RemeshFlag::kPatchBudget);
    for ([[maybe_unused]] const uint32_t once : left.patches.take(0, 1)) {
      merge_patch(patch, tether, left.tets);
    }
    return true;
  }

  void merge_patch(const Patch& patch, const Tether& tether, TetTotals& tets) {
    turn_.body.before_removal(tether.node, tether.end);
    for (const uint32_t i : tets.noted.take(0, patch.count)) {
      const uint16_t leaf = turn_.place_of(forest_.child(patch.tet[i], 0));
      urgencies_.of[leaf] = Urgency::kNeutral;
      --turn_.front.leaves[forest_.leaf[leaf].group].count;
    }
    merge(forest_, patch, tets, [this](uint16_t gap, uint16_t from) { urgencies_.move(gap, from); });
    turn_.body.removed(tether.end);
    turn_.counters.merged += patch.count;
    turn_.changed = true;
  }

  /// The parents around a tethered node; false when one of their children was split.
  [[nodiscard]] bool find_patch_around(const Tether& tether, Patch& patch) const {
    if (!forest_.pairs.is_live(tether.tet >> 1) || forest_.tet[tether.tet].is_leaf()) return false;
    const uint16_t child = forest_.child(tether.tet, 0);
    if (!forest_.tet[child].is_leaf() || middle_node(forest_.leaf_of(child)) != tether.node) return false;
    return find_merge(forest_, child, patch) == MeshStatus::kDone;
  }

  /// Whether no child of these parents is more urgent than that, holds the pinned node, or is a rotation tet:
  /// such a merge waits until the rotation front has risen.
  [[nodiscard]] bool may_merge(const Patch& patch, uint8_t most_urgent) const {
    bool may = true;
    const uint32_t end = refinement_end(type_of_level(forest_.level_of(patch.tet[0])));
    for (const uint32_t i : bounded<kMaxPatch>(patch.count, [] {})) {
      const uint16_t child0 = forest_.child(patch.tet[i], 0);
      const uint16_t place0 = turn_.place_of(child0);
      const uint16_t place1 = turn_.place_of(Forest<Profile>::sibling(child0));
      const Leaf& leaf0 = forest_.leaf[place0];
      // Of the second child's nodes all but one are the first one's too, and so is a group above the two.
      may = all_of(may, urgencies_.of[place0] <= most_urgent, urgencies_.of[place1] <= most_urgent,
                   turn_.front.tet[leaf0.group] != child0, !touches(leaf0, turn_.pinned),
                   forest_.leaf[place1].node[end - 1] != turn_.pinned);
    }
    return may;
  }

  /// Whether the edge that a merge restores is longer than that. The halves of the six edges are edges of the
  /// children, but of the longest ones no leaf has looked at this. A node is drawn only where the edge is
  /// calm, and merged unless it would be split again at once: with one limit for both, a node might be drawn
  /// and let go for ever.
  [[nodiscard]] bool restores_above(StretchMeasure limit, const Patch& patch, const EdgeEnds& ends) const {
    if (turn_.rules.criterion != StretchCriterion::kLongestEdge) return false;
    return refinement_edge_stretch(forest_.node, ends, forest_.level_of(patch.tet[0])) > limit;
  }

  void draw(const Leaf& leaf) {
    const uint16_t middle = middle_node(leaf);
    Patch patch{};
    if (tethers_.holds(middle)) return;
    if (find_merge(forest_, leaf.tet, patch) != MeshStatus::kDone || !may_merge(patch, Urgency::kCalm))
      return;
    const EdgeEnds ends = restored_edge(forest_, patch.tet[0]);
    if (turn_.is_tethered(ends) || loses_hold(middle, ends) ||
        restores_above(turn_.rules.merge_below, patch, ends)) {
      return;
    }
    if (tethers_.is_full()) return turn_.flag(RemeshFlag::kTethers);
    turn_.tether(middle, ends, patch.tet[0], TetherKind::kDraw);
  }

  /// Whether something else moves the node, but not both ends of its edge.
  [[nodiscard]] bool loses_hold(uint16_t middle, const EdgeEnds& ends) const {
    const Body& body = turn_.body;
    return !body.is_free(middle) && (body.is_free(ends[0]) || body.is_free(ends[1]));
  }

  MeshTurn<Profile, Body>& turn_;
  Forest<Profile>& forest_;
  Tethers<Profile>& tethers_;
  Urgencies<Profile>& urgencies_;
};

}  // namespace palpate
