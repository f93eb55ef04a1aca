// Changes of the rotation front in one tick: pairs that have blended to their parent's rotation are joined,
// the worst groups are split, calm pairs start to blend. A group sleeps while it blends.
//
// Misfits are judged group by group. With the other criteria the front conforms: all tets around an edge are
// split, begin to join, part and are joined in the same tick (front_patch.hpp).
//
// `Rotations` is what elasticity knows and does; a struct with
//   uint32_t split_measure(group)             how much is wrong with the group as it is; larger is worse
//   uint32_t join_measure(group, partner)     how much would be wrong with the two as one: the misfit of
//                                             both under one rotation; of siblings how far they, or their
//                                             parent and its sibling, are apart; full corotation: 0 for two
//                                             leaves about to be merged, else 1
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
        begun_(bounded_total<Profile::kRotationChanges>(BegunTotal{})),
        ended_(bounded_total<Profile::kRotationChanges>(EndedTotal{})) {}

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
  struct BegunTotal {};
  struct EndedTotal {};
  struct TriesTotal {};

  using Class = uint8_t;
  static constexpr Class kNotWanted = 255;

  void flag(RemeshFlag which) { flags_ |= static_cast<uint32_t>(which); }
  [[nodiscard]] bool is_conforming() const {
    return Profile::kStudyCriteria && has_conforming_front(rules_.criterion);
  }
  [[nodiscard]] uint8_t level_of(uint16_t group) const { return forest_.level_of(front_.tet[group]); }
  [[nodiscard]] bool is_leaf(uint16_t group) const { return forest_.tet[front_.tet[group]].is_leaf(); }

  /// A pair whose misfits grew meanwhile parts. Pairs of a conforming front began with their whole patch, and
  /// end with it. From the last group down, since a join puts the last one into the place of the one that
  /// goes.
  void end_joins() {
    const uint32_t count = front_.groups.used();
    for (const uint32_t i : bounded<Profile::kGroups>(count, [] {})) {
      const uint16_t group = front_.groups.live(count - 1 - i);
      const uint16_t partner = front_.partner[group];
      if (partner == kNone || is_second_of_pair(front_, group) || rotations_.is_blending(group)) continue;
      if (ended_.left() == 0) return;
      for ([[maybe_unused]] const uint32_t once : ended_.take(0, 1)) end_join(group, partner);
    }
  }

  void end_join(uint16_t group, uint16_t partner) {
    if (!is_conforming() && worst_of(group, partner) > rules_.split_above) return part(group, partner);
    if (front_.leaves[partner].count > leaves_.left()) return;
    join_groups(forest_, front_, group, partner, leaves_);
    rotations_.take_over(group, partner);
    ++counters_.groups_joined;
    changed_ = true;
  }

  [[nodiscard]] uint32_t worst_of(uint16_t group, uint16_t partner) const {
    const uint32_t a = rotations_.split_measure(group);
    const uint32_t b = rotations_.split_measure(partner);
    return a > b ? a : b;
  }

  void part(uint16_t group, uint16_t partner) {
    front_.partner[group] = kNone;
    front_.partner[partner] = kNone;
    rotations_.blend(group);
    rotations_.blend(partner);
  }

  /// All pairs whose parents are around one edge.
  void part_patch(uint16_t parent) {
    FrontPatch patch{};
    (void)find_front_patch(forest_, front_, parent, patch);
    for (const uint32_t i : bounded<kMaxPatch>(patch.count, [] {})) {
      const uint16_t group = first_group(patch.tet[i]);
      if (is_first_child(group, patch.tet[i]) && front_.partner[group] != kNone)
        part(group, front_.partner[group]);
    }
  }

  [[nodiscard]] bool wants_split(uint16_t group) const {
    return !is_leaf(group) && is_steady(group) && rotations_.split_measure(group) > rules_.split_above;
  }

  /// The classes of the groups that want to be split.
  [[nodiscard]] ClassCounts find_wanted() {
    ClassCounts classes;
    for (const uint32_t i : bounded<Profile::kGroups>(front_.groups.used(), [] {})) {
      const uint16_t group = front_.groups.live(i);
      wanted_[group] = kNotWanted;
      if (!wants_split(group)) continue;
      wanted_[group] = static_cast<Class>(class_of(rotations_.split_measure(group)));
      classes.add(wanted_[group]);
    }
    return classes;
  }

  void split_worst() {
    const ClassCounts classes = find_wanted();
    const uint32_t wanted = classes.total();
    counters_.groups_waiting = static_cast<uint16_t>(wanted);
    if (wanted == 0) return;
    const auto room = static_cast<uint32_t>(Profile::kGroups - front_.groups.used());
    const uint32_t each = is_conforming() ? kMaxPatch : 1;  // at most so many are split for one that wants it
    const uint32_t lowest = classes.lowest_within((begun_.left() < room ? begun_.left() : room) / each);
    auto tries = bounded_total<Profile::kGroups>(TriesTotal{});  // each group is of one class
    (void)(split_classes(lowest + 1, kClasses, tries) && split_classes(lowest, lowest + 1, tries) &&
           split_classes(0, lowest, tries));
  }

  /// Those from `low` to below `end`. False when nothing more can be split in this tick.
  template <class Total>
  bool split_classes(uint32_t low, uint32_t end, Total& tries) {
    for (const uint32_t i : bounded<Profile::kGroups>(front_.groups.used(), [] {})) {
      const uint16_t group = front_.groups.live(i);
      if (wanted_[group] < low || wanted_[group] >= end) continue;
      bool goes_on = true;
      for ([[maybe_unused]] const uint32_t once : tries.take(0, 1)) goes_on = split_if_wanted(group);
      if (!goes_on) return false;
    }
    return true;
  }
  bool split_if_wanted(uint16_t group) {
    if (wants_split(group)) return split_wanted(group);
    drop(group);  // its sibling was split: it has nothing left to differ from
    return true;
  }

  void drop(uint16_t group) {
    if (wanted_[group] != kNotWanted) --counters_.groups_waiting;
    wanted_[group] = kNotWanted;
  }

  /// False when nothing more can be split in this tick.
  bool split_wanted(uint16_t group) {
    if (!is_conforming()) return split_one(group);
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
    if (members > begun_.left()) return refuse(RemeshFlag::kRotationBudget);
    if (leaves > leaves_.left()) return false;
    if (!front_.groups.has_room(members)) return refuse(RemeshFlag::kGroups);
    for (const uint32_t i : bounded<kMaxPatch>(members, [] {})) {
      if (front_.partner[member[i]] != kNone) part_patch(forest_.parent_of(front_.tet[member[i]]));
      split_one(member[i]);
    }
    return true;
  }

  bool refuse(RemeshFlag which) {
    flag(which);
    return false;
  }

  bool split_one(uint16_t group) {
    if (begun_.left() == 0) return refuse(RemeshFlag::kRotationBudget);
    if (front_.leaves[group].count > leaves_.left()) return false;
    if (!front_.groups.has_room(1)) return refuse(RemeshFlag::kGroups);
    for ([[maybe_unused]] const uint32_t once : begun_.take(0, 1)) {
      const uint16_t added = split_group(forest_, front_, group, leaves_);
      rotations_.inherit(group, added);
      drop(group);
      wanted_[added] = kNotWanted;
      ++counters_.groups_split;
      changed_ = true;
    }
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
      const uint16_t group = front_.groups.live(i);
      if (!can_join(group)) continue;
      const bool fits =
          is_conforming() ? begin_patch(forest_.parent_of(front_.tet[group])) : begun_.left() > 0;
      if (!fits) {
        flag(RemeshFlag::kRotationBudget);
        return;
      }
      if (!is_conforming()) begin_join(group);
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
    for ([[maybe_unused]] const uint32_t once : begun_.take(0, 1)) {
      const uint16_t other = sibling_of(group);
      front_.partner[group] = other;
      front_.partner[other] = group;
      rotations_.blend(group);
      rotations_.blend(other);
    }
  }

  /// All pairs whose parents are around one edge, or none while some are not calm. False when they are and
  /// have to wait for the budget. Where the front is coarser already, none is needed.
  bool begin_patch(uint16_t parent) {
    FrontPatch patch{};
    (void)find_front_patch(forest_, front_, parent, patch);
    for (const uint32_t i : bounded<kMaxPatch>(patch.count, [] {})) {
      const uint16_t group = first_group(patch.tet[i]);
      if (front_.tet[group] == patch.tet[i]) continue;
      if (!is_first_child(group, patch.tet[i]) || !can_join(group)) return true;
    }
    if (patch.count > begun_.left()) return false;
    for (const uint32_t i : bounded<kMaxPatch>(patch.count, [] {})) {
      const uint16_t group = first_group(patch.tet[i]);
      if (front_.tet[group] != patch.tet[i]) begin_join(group);
    }
    return true;
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
  decltype(bounded_total<Profile::kLeaves>(LeavesTotal{})) leaves_;
  decltype(bounded_total<Profile::kRotationChanges>(BegunTotal{})) begun_;  // splits and joins
  decltype(bounded_total<Profile::kRotationChanges>(EndedTotal{})) ended_;  // joins
  std::array<Class, Profile::kGroups> wanted_;  // of each group in use, set by find_wanted
  uint32_t flags_ = 0;
  bool changed_ = false;
};

}  // namespace palpate
