// What the changes of a turn of the rotation front have in common: what they work on, what they may do to a
// group or a pair, and what came of it. rotation_changes.hpp has the turn.
//
// `Rotations` is what elasticity knows and does; a struct with
//   uint32_t split_measure(group)             how much is wrong with the group as it is; larger is worse
//   uint32_t join_measure(group, partner)     how much would be wrong with the two as one: the misfit of
//                                             both under one rotation; of siblings how far they, or their
//                                             parent and its sibling, are apart; full corotation: 0 for two
//                                             leaves about to be merged, else 1
//   bool is_blending(group), bool changed_now(group)
//   void blend(group)                         both measures sleep for a while
//   void inherit(group, added)                after a split
//   void take_over(group, gone)               after a join
#pragma once

#include "palpate/mesh/patch.hpp"
#include "palpate/mesh/rotation_front.hpp"
#include "palpate/remesh/turn_outcome.hpp"
#include "palpate/remesh/worst_first.hpp"

namespace palpate {

template <class Profile, class Rotations>
struct RotationTurn : TurnOutcome {
  /// By twos through all leaves, and for each group split or joined a leaf that is left.
  static constexpr uint32_t kSteps = Profile::kLeaves / 2 + Profile::kRotationChanges;

  RotationTurn(Forest<Profile>& the_forest, RotationFront<Profile>& the_front, const RotationRules& the_rules,
               Rotations& the_rotations, RemeshCounters& the_counters)
      : forest(the_forest),
        front(the_front),
        rules(the_rules),
        rotations(the_rotations),
        counters(the_counters),
        steps(bounded_total<kSteps>(StepsTotal{})),
        begun(bounded_total<Profile::kRotationChanges>(BegunTotal{})),
        ended(bounded_total<Profile::kRotationChanges>(EndedTotal{})) {}

  [[nodiscard]] uint8_t level_of(uint16_t group) const { return forest.level_of(front.tet[group]); }
  [[nodiscard]] bool is_leaf(uint16_t group) const { return forest.tet[front.tet[group]].is_leaf(); }
  [[nodiscard]] bool is_steady(uint16_t group) const {
    return all_of(front.partner[group] == kNone, !rotations.is_blending(group));
  }
  [[nodiscard]] uint32_t steps_of(uint16_t group) const { return steps_by_twos(front.leaves[group].count); }
  [[nodiscard]] uint16_t first_group(uint16_t tet) const {
    return forest.leaf_of(first_leaf(forest, tet)).group;
  }
  /// The group on this one's sibling tet, or kNone.
  [[nodiscard]] uint16_t sibling_of(uint16_t group) const {
    const uint16_t tet = front.tet[group];
    if (forest.parent_of(tet) == kNone) return kNone;
    const uint16_t sibling = Forest<Profile>::sibling(tet);
    const uint16_t other = first_group(sibling);
    return front.tet[other] == sibling ? other : kNone;
  }
  /// The sibling's group of a first child's one, where the two are calm; else kNone.
  [[nodiscard]] uint16_t calm_sibling(uint16_t group) const {
    if (!all_of(!is_second_of_pair(front, group), level_of(group) > rules.start_level, is_steady(group))) {
      return kNone;
    }
    const uint16_t other = sibling_of(group);
    const bool are_calm =
        other != kNone && is_steady(other) && rotations.join_measure(group, other) < rules.join_below;
    return are_calm ? other : kNone;
  }

  /// By how much it wants to be split.
  [[nodiscard]] Rank rank(uint16_t group) const {
    const bool may = all_of(!is_leaf(group), is_steady(group));
    if constexpr (Profile::kStudyCriteria) {
      if (!may) return kUnwanted;  // their measures are dear
    }
    const uint32_t measure = rotations.split_measure(group);
    return rank_of(measure, all_of(may, measure > rules.split_above));
  }
  /// Ranks all groups by how much they want to be split.
  [[nodiscard]] RankCounts find_wanted() {
    RankCounts ranks;
    for (const uint32_t i : bounded<Profile::kGroups>(front.groups.used(), [] {})) {
      const uint16_t group = front.groups.live(i);
      wanted[group] = rank(group);
      ranks.add(wanted[group]);
    }
    return ranks;
  }
  void drop(uint16_t group) {
    if (wanted[group] != kUnwanted) --counters.groups_waiting;
    wanted[group] = kUnwanted;
  }

  bool split_one(uint16_t group) {
    if (begun.left() == 0 || front.groups.used() == Profile::kGroups) return refuse_split();
    if (steps_of(group) > steps.left()) return false;
    for ([[maybe_unused]] const uint32_t once : begun.take(0, 1)) {
      const uint16_t added = split_group(forest, front, group, steps);
      rotations.inherit(group, added);
      drop(group);
      wanted[added] = kUnwanted;
      ++counters.groups_split;
      changed = true;
    }
    return true;
  }
  bool refuse_split() {
    if (begun.left() == 0) return refuse(RemeshFlag::kRotationBudget);
    (void)front.groups.has_room(1);  // which counts it
    return refuse(RemeshFlag::kGroups);
  }

  /// The pair extracts its parent's rotation from now on, which counts as a change.
  void begin_join(uint16_t group, uint16_t other) {
    for ([[maybe_unused]] const uint32_t once : begun.take(0, 1)) {
      front.partner[group] = other;
      front.partner[other] = group;
      rotations.blend(group);
      rotations.blend(other);
    }
  }
  void part(uint16_t group, uint16_t partner) {
    front.partner[group] = kNone;
    front.partner[partner] = kNone;
    rotations.blend(group);
    rotations.blend(partner);
  }

  struct StepsTotal {};
  struct BegunTotal {};
  struct EndedTotal {};

  Forest<Profile>& forest;
  RotationFront<Profile>& front;
  const RotationRules& rules;
  Rotations& rotations;
  RemeshCounters& counters;
  decltype(bounded_total<kSteps>(StepsTotal{})) steps;  // through leaves of groups split and joined
  decltype(bounded_total<Profile::kRotationChanges>(BegunTotal{})) begun;  // splits and joins
  decltype(bounded_total<Profile::kRotationChanges>(EndedTotal{})) ended;  // joins
  std::array<Rank, Profile::kGroups> wanted;  // of each group in use, set by find_wanted
};

}  // namespace palpate
