// A turn of the simulation front. Every leaf has an urgency, renewed in slices: how much it
// wants to be split. The most urgent leaves are split, each with its whole patch, coarser patches first; a
// leaf that has to wait keeps its urgency, which grows with every renewal, so none starves. One whose patch
// has to wait for a tether does not hold the others up: it is passed over. Calm patches are merged, after
// their middle node was drawn to where its removal changes nothing.
//
// `Body` is what the solver knows and does; a struct with
//   bool is_free(node)                                       nothing else moves it
//   void added(node, ends)                                   after a split
//   void before_removal(node, ends), void removed(ends)      around a merge
#pragma once

#include "palpate/mesh/patch.hpp"
#include "palpate/mesh/rotation_front.hpp"
#include "palpate/mesh/tether.hpp"
#include "palpate/remesh/urgency.hpp"

namespace palpate {

template <class Profile, class Body>
class MeshChanges {
 public:
  /// `pinned`: a node whose leaves go to their finest level and are never merged, or kNone.
  MeshChanges(Forest<Profile>& forest, RotationFront<Profile>& front, Tethers<Profile>& tethers,
              Urgencies<Profile>& urgencies, const StretchRules& rules, uint16_t pinned, Body& body,
              RemeshCounters& counters)
      : forest_(forest),
        front_(front),
        tethers_(tethers),
        urgencies_(urgencies),
        rules_(rules),
        pinned_(pinned),
        body_(body),
        counters_(counters) {}

  /// Returns RemeshFlag bits. A tick of the tethers is in it.
  uint32_t run() {
    if (rules_.criterion == StretchCriterion::kFixed) return 0;
    end_tethers();
    split_most_urgent();
    draw_calm();
    return flags_;
  }
  /// Whether the lists of the front need index_groups.
  [[nodiscard]] bool changed() const { return changed_; }

 private:
  using Urgency = Urgencies<Profile>;
  static constexpr uint32_t kLooks = MostUrgent<Profile>::kLooks;
  static constexpr uint32_t kSteps = kLooks + Profile::kMaxLevel;
  struct StepsTotal {};
  struct SplitsTotal {};
  struct SplitTets {};
  /// Of a tick: patches that are looked at on the way to those that are ready, and those that are bisected.
  struct SplitBudget {
    decltype(bounded_total<kSteps>(StepsTotal{})) steps;
    decltype(bounded_total<Profile::kPatches>(SplitsTotal{})) patches;
    PatchTotals<Profile::kTetsSplit, SplitTets> tets;
  };
  struct LooksTotal {};
  struct MergesTotal {};
  struct MergeTets {};
  /// What ends in a tick: tethers whose patch is looked at, and patches that are merged.
  struct MergeBudget {
    decltype(bounded_total<2 * Profile::kPatches>(LooksTotal{})) looks;
    decltype(bounded_total<Profile::kPatches>(MergesTotal{})) patches;
    PatchTotals<Profile::kTetsMerged, MergeTets> tets;
  };

  void flag(RemeshFlag which) { flags_ |= static_cast<uint32_t>(which); }

  void split_most_urgent() {
    MostUrgent<Profile> wanted;
    waiting_ = find_most_urgent(
        forest_, urgencies_, [this](const Leaf& leaf) { return tethered(refinement_edge(leaf)); }, wanted);
    SplitBudget left{
        bounded_total<kSteps>(StepsTotal{}), bounded_total<Profile::kPatches>(SplitsTotal{}), {}};
    for (const uint32_t i : bounded<kLooks>(wanted.count(), [] {})) {
      if (left.patches.left() == 0) break;
      const uint16_t leaf = wanted.leaf(i);
      if (urgencies_.of[leaf] < Urgency::kWanted) continue;  // split by an earlier patch
      urgencies_.split_at = static_cast<uint16_t>(leaf / Urgency::kBlock + 1);
      if (!split_towards(leaf, left)) break;
    }
    counters_.leaves_waiting = static_cast<uint16_t>(waiting_.all);
    if (waiting_.all > waiting_.blocked && flags_ == 0) flag(RemeshFlag::kPatchBudget);
  }

  /// No edge is split at a slaved node. 0 or 1, without a branch.
  [[nodiscard]] uint32_t tethered(const EdgeEnds& ends) const {
    return static_cast<uint32_t>(tethers_.holds_node[ends[0]]) | tethers_.holds_node[ends[1]];
  }
  [[nodiscard]] bool is_tethered(const EdgeEnds& ends) const { return tethered(ends) != 0; }
  [[nodiscard]] uint16_t place_of(uint16_t leaf_tet) const { return forest_.tet[leaf_tet].link(); }

  /// Splits the patch of a leaf, or the coarser one in its way. False when nothing more can be split now.
  bool split_towards(uint16_t leaf, SplitBudget& left) {
    Patch patch{};
    const MeshStatus found = find_ready_patch(forest_, forest_.leaf[leaf].tet, patch, left.steps);
    if (found == MeshStatus::kNotReady) return false;
    if (found != MeshStatus::kDone || !stays_within_levels(patch)) {
      urgencies_.of[leaf] = Urgency::kBarred;
      --waiting_.all;
      return true;
    }
    const EdgeEnds ends = refinement_edge(forest_.leaf_of(patch.tet[0]));
    if (is_tethered(ends)) {
      urgencies_.of[leaf] |= Urgency::kAsleep;
      ++waiting_.blocked;
      return true;
    }
    if (patch.count > left.tets.left()) return false;
    if (tethers_.is_full()) return refuse(RemeshFlag::kTethers);
    bool is_split = false;
    for ([[maybe_unused]] const uint32_t once : left.patches.take(0, 1)) {
      is_split = split(patch, ends, left.tets);
    }
    return is_split;
  }

  bool split(const Patch& patch, const EdgeEnds& ends, PatchTotals<Profile::kTetsSplit, SplitTets>& tets) {
    switch (bisect(forest_, patch, tets)) {
      case MeshStatus::kDone:
        after_split(patch, ends, tets);
        return true;
      case MeshStatus::kNodesFull:
        return refuse(RemeshFlag::kNodes);
      default:
        return refuse(RemeshFlag::kLeaves);
    }
  }

  /// Also a coarser patch in a leaf's way, perhaps of another region, must not pass its region's finest
  /// level.
  [[nodiscard]] bool stays_within_levels(const Patch& patch) const {
    bool stays = true;
    for (const uint32_t i : bounded<kMaxPatch>(patch.count, [] {})) {
      const Leaf& leaf = forest_.leaf_of(patch.tet[i]);
      stays = all_of(stays, leaf.level() < rules_.levels[leaf.region()].most);
    }
    return stays;
  }

  bool refuse(RemeshFlag which) {
    flag(which);
    return false;
  }

  /// Of two children the first has their parent's place, and its urgency till now.
  void after_split(const Patch& patch, const EdgeEnds& ends,
                   PatchTotals<Profile::kTetsSplit, SplitTets>& tets) {
    for (const uint32_t i : tets.noted.take(0, patch.count)) {
      const uint16_t leaf = place_of(forest_.child(patch.tet[i], 0));
      const uint8_t urgency = urgencies_.of[leaf];
      waiting_.all -= urgency >= Urgency::kWanted ? 1u : 0u;
      waiting_.blocked -= urgency > Urgency::kMost ? 1u : 0u;
      urgencies_.of[leaf] = Urgency::kNeutral;
      ++front_.leaves[forest_.leaf[leaf].group].count;
    }
    const uint16_t middle = middle_node(forest_.leaf_of(forest_.child(patch.tet[0], 0)));
    body_.added(middle, ends);
    if (body_.is_free(middle)) tether(middle, ends, patch.tet[0], TetherKind::kRelease);
    counters_.bisected += patch.count;
    changed_ = true;
  }

  void tether(uint16_t middle, const EdgeEnds& ends, uint16_t tet, TetherKind kind) {
    tethers_.add(Tether{middle, {ends[0], ends[1]}, tet, kTetherTicks, kind, 0});
  }

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
      const bool is_taken = tether.node == pinned_;  // by the tool: nothing else moves it
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
    if (have_to_wait) flag(RemeshFlag::kPatchBudget);
  }
  /// More cannot end in a turn: releases of as many patches as are split, and of as many draws as fail;
  /// draws that are looked at; and what the tool takes.
  static constexpr uint32_t kMostEnds = 5 * Profile::kPatches + 1;

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
        restores_above(rules_.split_above, patch, tether.end)) {
      tether.kind = TetherKind::kRelease;
      tether.ticks_left = kTetherTicks;
      return false;
    }
    if (patch.count > left.tets.left()) return refuse(RemeshFlag::kPatchBudget);
    for ([[maybe_unused]] const uint32_t once : left.patches.take(0, 1)) {
      merge_patch(patch, tether, left.tets);
    }
    return true;
  }

  void merge_patch(const Patch& patch, const Tether& tether,
                   PatchTotals<Profile::kTetsMerged, MergeTets>& tets) {
    body_.before_removal(tether.node, tether.end);
    for (const uint32_t i : tets.noted.take(0, patch.count)) {
      const uint16_t leaf = place_of(forest_.child(patch.tet[i], 0));
      urgencies_.of[leaf] = Urgency::kNeutral;
      --front_.leaves[forest_.leaf[leaf].group].count;
    }
    merge(forest_, patch, tets, [this](uint16_t gap, uint16_t from) { urgencies_.move(gap, from); });
    body_.removed(tether.end);
    counters_.merged += patch.count;
    changed_ = true;
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
      const uint16_t place0 = place_of(child0), place1 = place_of(Forest<Profile>::sibling(child0));
      const Leaf& leaf0 = forest_.leaf[place0];
      // Of the second child's nodes all but one are the first one's too, and so is a group above the two.
      may = all_of(may, urgencies_.of[place0] <= most_urgent, urgencies_.of[place1] <= most_urgent,
                   front_.tet[leaf0.group] != child0, !touches(leaf0, pinned_),
                   forest_.leaf[place1].node[end - 1] != pinned_);
    }
    return may;
  }

  /// Whether the edge that a merge restores is longer than that. The halves of the six edges are edges of the
  /// children, but of the longest ones no leaf has looked at this. A node is drawn only where the edge is
  /// calm, and merged unless it would be split again at once: with one limit for both, a node might be drawn
  /// and let go for ever.
  [[nodiscard]] bool restores_above(StretchMeasure limit, const Patch& patch, const EdgeEnds& ends) const {
    if (rules_.criterion != StretchCriterion::kLongestEdge) return false;
    return refinement_edge_stretch(forest_.node, ends, forest_.level_of(patch.tet[0])) > limit;
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

  void draw(const Leaf& leaf) {
    const uint16_t middle = middle_node(leaf);
    Patch patch{};
    if (tethers_.holds(middle)) return;
    if (find_merge(forest_, leaf.tet, patch) != MeshStatus::kDone || !may_merge(patch, Urgency::kCalm))
      return;
    const EdgeEnds ends = restored_edge(forest_, patch.tet[0]);
    if (is_tethered(ends) || loses_hold(middle, ends) || restores_above(rules_.merge_below, patch, ends))
      return;
    if (tethers_.is_full()) return flag(RemeshFlag::kTethers);
    tether(middle, ends, patch.tet[0], TetherKind::kDraw);
  }

  /// Whether something else moves the node, but not both ends of its edge.
  [[nodiscard]] bool loses_hold(uint16_t middle, const EdgeEnds& ends) const {
    return !body_.is_free(middle) && (body_.is_free(ends[0]) || body_.is_free(ends[1]));
  }

  Forest<Profile>& forest_;
  RotationFront<Profile>& front_;
  Tethers<Profile>& tethers_;
  Urgencies<Profile>& urgencies_;
  const StretchRules& rules_;
  uint16_t pinned_;
  Body& body_;
  RemeshCounters& counters_;
  Waiting waiting_{0, 0};
  uint32_t flags_ = 0;
  bool changed_ = false;
};

}  // namespace palpate
