// Changes of the rotation front in one tick: pairs that have blended to their parent's rotation are joined,
// the worst groups are split, calm pairs start to blend. A group sleeps while it blends.
//
// `Rotations` is what elasticity knows and does; a struct with
//   uint32_t split_measure(group)             larger is worse
//   uint32_t join_measure(group, partner)     of both under their parent's rotation, from above
//   bool is_blending(group), bool changed_now(group)
//   void blend(group)                         both measures sleep for some ticks
//   void inherit(group, added)                after a split
//   void take_over(group, gone)               after a join
#pragma once

#include "palpate/mesh/front_patch.hpp"
#include "palpate/remesh/rules.hpp"
#include "palpate/remesh/worst_first.hpp"

namespace palpate {

template <class Profile, class Rotations>
class RotationChanges {
 public:
  RotationChanges(Forest<Profile>& forest, RotationFront<Profile>& front, const RotationRules& rules,
                  Rotations& rotations, RemeshCounters& counters)
      : forest_(forest),
        front_(front),
        rules_(rules),
        rotations_(rotations),
        counters_(counters),
        leaves_(bounded_total<Profile::kLeaves>(LeavesTotal{})),
        budget_(Profile::kRotationChanges) {}

  /// Returns RemeshFlag bits; `changed` says whether the lists of the front need index_groups.
  uint32_t run(bool& changed) {
    end_joins();
    split_worst();
    begin_joins();
    changed = changed || changed_;
    return flags_;
  }

 private:
  struct LeavesTotal {};
  using Total = decltype(bounded_total<Profile::kLeaves>(LeavesTotal{}));

  void flag(RemeshFlag which) { flags_ |= static_cast<uint32_t>(which); }
  [[nodiscard]] uint8_t level_of(uint16_t group) const { return forest_.tet[front_.tet[group]].level; }
  [[nodiscard]] bool is_leaf(uint16_t group) const { return forest_.tet[front_.tet[group]].is_leaf; }

  void end_joins() {
    for (const uint32_t i : bounded<Profile::kGroups>(front_.groups.used(), [] {})) {
      if (i >= front_.groups.used()) break;
      const uint16_t group = front_.groups.live(i);
      const uint16_t partner = front_.partner[group];
      if (partner == kNone || is_second_of_pair(front_, group) || rotations_.is_blending(group)) continue;
      const uint32_t worst = larger(rotations_.split_measure(group), rotations_.split_measure(partner));
      if (worst > rules_.split_above) {
        part(group, partner);
      } else if (front_.leaves[partner].count <= leaves_.left()) {
        join_groups(forest_, front_, group, partner, leaves_);
        rotations_.take_over(group, partner);
        ++counters_.groups_joined;
        changed_ = true;
      }
    }
  }

  static uint32_t larger(uint32_t a, uint32_t b) { return a > b ? a : b; }

  void part(uint16_t group, uint16_t partner) {
    front_.partner[group] = kNone;
    front_.partner[partner] = kNone;
    rotations_.blend(group);
    rotations_.blend(partner);
  }

  [[nodiscard]] bool wants_split(uint16_t group) const {
    return !is_leaf(group) && front_.partner[group] == kNone && !rotations_.is_blending(group) &&
           rotations_.split_measure(group) > rules_.split_above;
  }

  void split_worst() {
    ClassCounts classes;
    for (const uint32_t i : bounded<Profile::kGroups>(front_.groups.used(), [] {})) {
      const uint16_t group = front_.groups.live(i);
      if (wants_split(group)) classes.add(class_of(rotations_.split_measure(group)));
    }
    const uint32_t wanted = classes.total();
    counters_.groups_waiting = static_cast<uint16_t>(wanted);
    if (wanted == 0) return;
    const uint32_t lowest = classes.lowest_within(budget_);
    for (const uint32_t i : bounded<Profile::kGroups>(front_.groups.used(), [] {})) {
      const uint16_t group = front_.groups.live(i);
      if (!wants_split(group) || class_of(rotations_.split_measure(group)) < lowest) continue;
      if (!split_wanted(group)) break;
      if (!wants_split(group)) --counters_.groups_waiting;
    }
    if (counters_.groups_waiting > 0 && (flags_ & static_cast<uint32_t>(RemeshFlag::kGroups)) == 0) {
      flag(RemeshFlag::kRotationBudget);
    }
  }

  /// False when nothing more can be split in this tick.
  bool split_wanted(uint16_t group) {
    if (rules_.criterion != RotationCriterion::kSiblings) return split_one(group);
    FrontPatch patch{};
    uint16_t wanted = group;
    for ([[maybe_unused]] const uint32_t step : bounded<Profile::kMaxLevel>(Profile::kMaxLevel, [] {})) {
      if (find_front_patch(forest_, front_, front_.tet[wanted], patch) == MeshStatus::kDone) break;
      wanted = patch.blocker;
    }
    return patch.blocker != kNone || split_patch(patch);
  }

  bool split_patch(const FrontPatch& patch) {
    std::array<uint16_t, kMaxPatch> member;
    uint32_t members = 0;
    uint32_t leaves = 0;
    for (const uint32_t i : bounded<kMaxPatch>(patch.count, [] {})) {
      const uint16_t group = first_group(patch.tet[i]);
      if (front_.tet[group] != patch.tet[i]) continue;  // already split
      if (rotations_.changed_now(group)) return true;   // its lists are stale: next tick
      member[members] = group;
      ++members;
      leaves += front_.leaves[group].count;
    }
    if (members > budget_ || leaves > leaves_.left()) return false;
    if (!front_.groups.has_room(members)) return refuse();
    for (const uint32_t i : bounded<kMaxPatch>(members, [] {})) {
      if (front_.partner[member[i]] != kNone) part(member[i], front_.partner[member[i]]);
      split_one(member[i]);
    }
    return true;
  }

  bool refuse() {
    flag(RemeshFlag::kGroups);
    return false;
  }

  bool split_one(uint16_t group) {
    if (budget_ == 0 || front_.leaves[group].count > leaves_.left()) return false;
    const uint16_t added = split_group(forest_, front_, group, leaves_);
    if (added == kNone) return refuse();
    rotations_.inherit(group, added);
    --budget_;
    ++counters_.groups_split;
    changed_ = true;
    return true;
  }

  /// The group on this one's sibling tet, or kNone.
  [[nodiscard]] uint16_t sibling_of(uint16_t group) const {
    const uint16_t tet = front_.tet[group];
    if (forest_.parent_of(tet) == kNone) return kNone;
    const uint16_t sibling = Forest<Profile>::sibling(tet);
    const uint16_t other = first_group(sibling);
    return front_.tet[other] == sibling ? other : kNone;
  }

  void begin_joins() {
    for (const uint32_t i : bounded<Profile::kGroups>(front_.groups.used(), [] {})) {
      if (budget_ == 0) return;
      const uint16_t group = front_.groups.live(i);
      if (!can_join(group)) continue;
      if (rules_.criterion == RotationCriterion::kSiblings) {
        begin_patch(forest_.parent_of(front_.tet[group]));
      } else {
        begin_join(group);
      }
    }
  }

  /// Whether the group is a first child, and calm with its sibling.
  [[nodiscard]] bool can_join(uint16_t group) const {
    if (is_second_of_pair(front_, group) || level_of(group) <= rules_.start_level || !is_steady(group)) {
      return false;
    }
    const uint16_t other = sibling_of(group);
    return other != kNone && is_steady(other) && rotations_.join_measure(group, other) < rules_.join_below;
  }

  [[nodiscard]] bool is_steady(uint16_t group) const {
    return front_.partner[group] == kNone && !rotations_.is_blending(group);
  }

  /// The pair extracts its parent's rotation from now on, which counts as a change.
  void begin_join(uint16_t group) {
    const uint16_t other = sibling_of(group);
    front_.partner[group] = other;
    front_.partner[other] = group;
    rotations_.blend(group);
    rotations_.blend(other);
    --budget_;
  }

  /// All pairs whose parents are around one edge, or none. Where the front is coarser already, none is
  /// needed.
  void begin_patch(uint16_t parent) {
    FrontPatch patch{};
    (void)find_front_patch(forest_, front_, parent, patch);
    if (patch.count > budget_) return;
    for (const uint32_t i : bounded<kMaxPatch>(patch.count, [] {})) {
      const uint16_t group = first_group(patch.tet[i]);
      if (front_.tet[group] != patch.tet[i] && !is_first_child(group, patch.tet[i])) return;
      if (front_.tet[group] != patch.tet[i] && !can_join(group)) return;
    }
    for (const uint32_t i : bounded<kMaxPatch>(patch.count, [] {})) {
      const uint16_t group = first_group(patch.tet[i]);
      if (front_.tet[group] != patch.tet[i]) begin_join(group);
    }
  }

  [[nodiscard]] uint16_t first_group(uint16_t tet) const {
    return forest_.leaf_of(first_leaf(forest_, tet)).group;
  }
  [[nodiscard]] bool is_first_child(uint16_t group, uint16_t parent) const {
    return front_.tet[group] == forest_.child(parent, 0);
  }

  Forest<Profile>& forest_;
  RotationFront<Profile>& front_;
  const RotationRules& rules_;
  Rotations& rotations_;
  RemeshCounters& counters_;
  Total leaves_;
  uint32_t budget_;
  uint32_t flags_ = 0;
  bool changed_ = false;
};

}  // namespace palpate
