// What only a conforming rotation front does (front_patch.hpp): all tets around an edge are split, begin to
// join, and part in the same turn. Its criteria are for studies: no code of it is in a profile without
// kStudyCriteria.
#pragma once

#include "palpate/mesh/front_patch.hpp"
#include "palpate/remesh/rotation_turn.hpp"

namespace palpate {

template <class Profile, class Rotations>
class ConformingChanges {
  static_assert(Profile::kStudyCriteria);

 public:
  explicit ConformingChanges(RotationTurn<Profile, Rotations>& turn)
      : turn_(turn), forest_(turn.forest), front_(turn.front) {}

  /// Of the wanted, all above that rank, then at it, then below, as long as there is something left.
  void split_patches(uint32_t rank) {
    (void)(split_ranks(rank + 1, kClasses + 1) && split_ranks(rank, rank + 1) && split_ranks(1, rank));
  }

  /// All pairs whose parents are around one edge, or none while some are not calm. False when they are and
  /// have to wait for the budget. Where the front is coarser already, none is needed.
  bool begin_patch(uint16_t parent) {
    FrontPatch patch{};
    (void)find_front_patch(forest_, front_, parent, patch);
    for (const uint32_t i : bounded<kMaxPatch>(patch.count, [] {})) {
      const uint16_t group = turn_.first_group(patch.tet[i]);
      if (front_.tet[group] == patch.tet[i]) continue;
      if (!is_first_child(group, patch.tet[i]) || turn_.calm_sibling(group) == kNone) return true;
    }
    if (patch.count > turn_.begun.left()) return false;
    for (const uint32_t i : bounded<kMaxPatch>(patch.count, [] {})) {
      const uint16_t group = turn_.first_group(patch.tet[i]);
      if (front_.tet[group] != patch.tet[i]) turn_.begin_join(group, turn_.sibling_of(group));
    }
    return true;
  }

 private:
  /// Those from `low` to below `end`. False when nothing more can be split in this turn.
  bool split_ranks(uint32_t low, uint32_t end) {
    for (const uint32_t i : bounded<Profile::kGroups>(front_.groups.used(), [] {})) {
      const uint16_t group = front_.groups.live(i);
      if (turn_.wanted[group] < low || turn_.wanted[group] >= end) continue;
      if (turn_.rank(group) == kUnwanted) {
        turn_.drop(group);  // its sibling was split: it has nothing left to differ from
      } else if (!split_around(group)) {
        return false;
      }
    }
    return true;
  }

  /// The patch of a group, or a coarser one in its way. False when nothing more can be split in this turn.
  bool split_around(uint16_t group) {
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
    uint32_t steps = 0;
    for (const uint32_t i : bounded<kMaxPatch>(patch.count, [] {})) {
      const uint16_t group = turn_.first_group(patch.tet[i]);
      if (front_.tet[group] != patch.tet[i]) continue;      // already split
      if (turn_.rotations.changed_now(group)) return true;  // its lists are stale: next turn
      member[members] = group;
      ++members;
      steps += turn_.steps_of(group);
    }
    if (members > turn_.begun.left()) return turn_.refuse(RemeshFlag::kRotationBudget);
    if (steps > turn_.steps.left()) return false;
    if (!front_.groups.has_room(members)) return turn_.refuse(RemeshFlag::kGroups);
    for (const uint32_t i : bounded<kMaxPatch>(members, [] {})) {
      if (front_.partner[member[i]] != kNone) part_patch(forest_.parent_of(front_.tet[member[i]]));
      turn_.split_one(member[i]);
    }
    return true;
  }

  /// All pairs whose parents are around one edge.
  void part_patch(uint16_t parent) {
    FrontPatch patch{};
    (void)find_front_patch(forest_, front_, parent, patch);
    for (const uint32_t i : bounded<kMaxPatch>(patch.count, [] {})) {
      const uint16_t group = turn_.first_group(patch.tet[i]);
      if (is_first_child(group, patch.tet[i]) && front_.partner[group] != kNone)
        turn_.part(group, front_.partner[group]);
    }
  }

  [[nodiscard]] bool is_first_child(uint16_t group, uint16_t parent) const {
    return front_.tet[group] == forest_.child(parent, 0);
  }

  RotationTurn<Profile, Rotations>& turn_;
  Forest<Profile>& forest_;
  RotationFront<Profile>& front_;
};

}  // namespace palpate
