// Changes of the simulation front in one tick. Every leaf has an urgency, renewed in slices: how much it
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

  /// Returns RemeshFlag bits; `changed` says whether the lists of the front need index_groups.
  uint32_t run(bool& changed) {
    if (rules_.criterion == StretchCriterion::kFixed) return 0;
    advance_tethers();
    renew_urgencies(forest_, rules_, pinned_, urgencies_);
    split_most_urgent();
    draw_calm();
    changed = changed || changed_;
    return flags_;
  }

 private:
  using Urgency = Urgencies<Profile>;
  static constexpr uint32_t kLooks = MostUrgent<Profile>::kLooks;
  static constexpr uint32_t kSteps = kLooks + Profile::kMaxLevel;
  struct StepsTotal {};
  struct SplitsTotal {};
  /// Of a tick: patches that are looked at on the way to those that are ready, and those that are bisected.
  struct SplitBudget {
    decltype(bounded_total<kSteps>(StepsTotal{})) steps;
    decltype(bounded_total<Profile::kPatches>(SplitsTotal{})) patches;
    uint32_t tets;
  };
  struct LooksTotal {};
  struct MergesTotal {};
  /// What ends in a tick: tethers whose patch is looked at, and patches that are merged.
  struct MergeBudget {
    decltype(bounded_total<2 * Profile::kPatches>(LooksTotal{})) looks;
    decltype(bounded_total<Profile::kPatches>(MergesTotal{})) patches;
    uint32_t tets;
  };

  void flag(RemeshFlag which) { flags_ |= static_cast<uint32_t>(which); }

  void split_most_urgent() {
    MostUrgent<Profile> wanted;
    waiting_ = find_most_urgent(
        forest_, urgencies_, [this](const Leaf& leaf) { return tethered(refinement_edge(leaf)); }, wanted);
    SplitBudget left{bounded_total<kSteps>(StepsTotal{}), bounded_total<Profile::kPatches>(SplitsTotal{}),
                     Profile::kTetsSplit};
    for (const uint32_t i : bounded<kLooks>(wanted.count(), [] {})) {
      if (left.patches.left() == 0) break;
      const uint16_t tet = wanted.tet(i);
      if (!forest_.tet[tet].is_leaf()) continue;  // split by an earlier patch
      urgencies_.split_at = static_cast<uint16_t>(tet / 4 + 1);
      if (!split_towards(tet, left)) break;
    }
    counters_.leaves_waiting = static_cast<uint16_t>(waiting_.all);
    if (waiting_.all > waiting_.blocked && flags_ == 0) flag(RemeshFlag::kPatchBudget);
  }

  /// No edge is split at a slaved node. 0 or 1, without a branch.
  [[nodiscard]] uint32_t tethered(const EdgeEnds& ends) const {
    return static_cast<uint32_t>(tethers_.holds_node[ends[0]]) | tethers_.holds_node[ends[1]];
  }
  [[nodiscard]] bool is_tethered(const EdgeEnds& ends) const { return tethered(ends) != 0; }

  /// Splits the patch of a leaf, or the coarser one in its way. False when nothing more can be split now.
  bool split_towards(uint16_t tet, SplitBudget& left) {
    Patch patch{};
    const MeshStatus found = find_ready_patch(forest_, tet, patch, left.steps);
    if (found == MeshStatus::kNotReady) return false;
    if (found != MeshStatus::kDone || !stays_within_levels(patch)) {
      urgencies_.of[tet] = Urgency::kBarred;
      --waiting_.all;
      return true;
    }
    const EdgeEnds ends = refinement_edge(forest_.leaf_of(patch.tet[0]));
    if (is_tethered(ends)) {
      urgencies_.of[tet] |= Urgency::kAsleep;
      ++waiting_.blocked;
      return true;
    }
    if (patch.count > left.tets) return false;
    if (tethers_.is_full()) return refuse(RemeshFlag::kTethers);
    left.tets -= patch.count;
    bool is_split = false;
    for ([[maybe_unused]] const uint32_t once : left.patches.take(0, 1)) is_split = split(patch, ends);
    return is_split;
  }

  bool split(const Patch& patch, const EdgeEnds& ends) {
    switch (bisect(forest_, patch)) {
      case MeshStatus::kDone:
        after_split(patch, ends);
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

  void after_split(const Patch& patch, const EdgeEnds& ends) {
    for (const uint32_t i : bounded<kMaxPatch>(patch.count, [] {})) {
      const uint8_t urgency = urgencies_.of[patch.tet[i]];
      waiting_.all -= urgency >= Urgency::kWanted ? 1u : 0u;
      waiting_.blocked -= urgency > Urgency::kMost ? 1u : 0u;
      urgencies_.of[patch.tet[i]] = Urgency::kNeutral;
      urgencies_.of[forest_.child(patch.tet[i], 0)] = Urgency::kNeutral;
      urgencies_.of[forest_.child(patch.tet[i], 1)] = Urgency::kNeutral;
      ++front_.leaves[forest_.leaf_of(forest_.child(patch.tet[i], 0)).group].count;
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

  void advance_tethers() {
    MergeBudget left{bounded_total<2 * Profile::kPatches>(LooksTotal{}),
                     bounded_total<Profile::kPatches>(MergesTotal{}), Profile::kTetsMerged};
    uint32_t at = 0;
    for ([[maybe_unused]] const uint32_t i : bounded<Profile::kTethers>(tethers_.count, [] {})) {
      Tether& tether = tethers_.tether[at];
      const bool is_taken = tether.node == pinned_;  // by the tool: nothing else moves it
      if (!is_taken && tether.ticks_left > 1) {
        --tether.ticks_left;
        ++at;
      } else if (is_taken || tether.kind == TetherKind::kRelease || merge_at(tether, left)) {
        tethers_.remove(at);
      } else {
        ++at;  // it holds the node where it is, or now lets go of it
      }
    }
  }

  /// Merges around a node that has been drawn. False, with the tether turned into a release, when the patch
  /// is no longer calm; false and as it was when the budget is used up.
  bool merge_at(Tether& tether, MergeBudget& left) {
    if (left.patches.left() == 0 || left.looks.left() == 0) return refuse(RemeshFlag::kPatchBudget);
    Patch patch{};
    bool is_calm = false;
    for ([[maybe_unused]] const uint32_t look : left.looks.take(0, 1)) {
      is_calm = find_patch_around(tether, patch) && may_merge(patch, Urgency::kNeutral) &&
                !restores_above(rules_.split_above, patch, tether.end);
    }
    if (!is_calm) {
      tether.kind = TetherKind::kRelease;
      tether.ticks_left = kTetherTicks;
      return false;
    }
    if (patch.count > left.tets) return refuse(RemeshFlag::kPatchBudget);
    left.tets -= patch.count;
    for ([[maybe_unused]] const uint32_t once : left.patches.take(0, 1)) merge_patch(patch, tether);
    return true;
  }

  void merge_patch(const Patch& patch, const Tether& tether) {
    for (const uint32_t i : bounded<kMaxPatch>(patch.count, [] {})) {
      urgencies_.of[patch.tet[i]] = Urgency::kNeutral;
    }
    body_.before_removal(tether.node, tether.end);
    merge(forest_, patch);
    for (const uint32_t i : bounded<kMaxPatch>(patch.count, [] {})) {
      --front_.leaves[forest_.leaf_of(patch.tet[i]).group].count;
    }
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
    for (const uint32_t i : bounded<kMaxPatch>(patch.count, [] {})) {
      for (const uint32_t which : bounded<2>(2, [] {})) {
        const Leaf& leaf = forest_.leaf_of(forest_.child(patch.tet[i], which));
        const uint8_t group_level = forest_.level_of(front_.tet[leaf.group]);
        may = all_of(may, urgencies_.of[leaf.tet] <= most_urgent, group_level < leaf.level(),
                     !touches(leaf, pinned_));
      }
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
      const Leaf& leaf = forest_.leaf[urgencies_.merge_at];
      ++urgencies_.merge_at;
      if (urgencies_.of[leaf.tet] != Urgency::kCalm || leaf.level() == 0) continue;
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
