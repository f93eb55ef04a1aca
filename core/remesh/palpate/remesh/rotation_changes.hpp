// A turn of the rotation front: pairs that have blended to their parent's rotation are joined, the worst
// groups are split, calm pairs start to blend. A group sleeps while it blends. For pairs a turn looks at a
// slice of the groups.
//
// Misfits are judged group by group. With the other criteria the front conforms: all tets around an edge are
// split, begin to join, part and are joined in the same turn, which looks at all groups.
#pragma once

#include "palpate/remesh/conforming_changes.hpp"
#include "palpate/remesh/rotation_turn.hpp"

namespace palpate {

/// Turns to look at all groups for pairs.
inline constexpr uint32_t kPairTurns = 8;

template <class Profile, class Rotations>
class RotationChanges {
 public:
  explicit RotationChanges(RotationTurn<Profile, Rotations>& turn)
      : turn_(turn), front_(turn.front), rotations_(turn.rotations) {}

  void run() {
    end_joins();
    split_worst();
    begin_joins();
  }

 private:
  static constexpr uint32_t kPairSlice = (Profile::kGroups + kPairTurns - 1) / kPairTurns;
  static constexpr uint32_t kMostPairs = Profile::kStudyCriteria ? Profile::kGroups : kPairSlice;

  [[nodiscard]] bool is_conforming() const {
    return Profile::kStudyCriteria && has_conforming_front(turn_.rules.criterion);
  }

  /// How many groups a turn looks at for pairs, from pairs_at on.
  [[nodiscard]] uint32_t pair_slice() const {
    const uint32_t rest = static_cast<uint32_t>(front_.groups.used()) - front_.pairs_at;
    return is_conforming() || rest < kPairSlice ? rest : kPairSlice;
  }

  /// A pair whose misfits grew meanwhile parts. Pairs of a conforming front began with their whole patch, and
  /// end with it. From the last group down, since a join puts the last one into the place of the one that
  /// goes; it may miss its turn.
  void end_joins() {
    if (is_conforming() || front_.pairs_at >= front_.groups.used()) front_.pairs_at = 0;
    const uint32_t end = front_.pairs_at + pair_slice();
    for (const uint32_t i : bounded<kMostPairs>(pair_slice(), [] {})) {
      const uint32_t place = end - 1 - i;
      if (place >= front_.groups.used()) continue;
      const uint16_t group = front_.groups.live(place);
      const uint16_t partner = front_.partner[group];
      if (!all_of(partner != kNone, !is_second_of_pair(front_, group), !rotations_.is_blending(group)))
        continue;
      if (turn_.ended.left() == 0) return;
      for ([[maybe_unused]] const uint32_t once : turn_.ended.take(0, 1)) end_join(group, partner);
    }
  }

  void end_join(uint16_t group, uint16_t partner) {
    if (!is_conforming() && worst_of(group, partner) > turn_.rules.split_above) {
      return turn_.part(group, partner);
    }
    if (turn_.steps_of(partner) > turn_.steps.left()) return;
    join_groups(turn_.forest, front_, group, partner, turn_.steps);
    rotations_.take_over(group, partner);
    ++turn_.counters.groups_joined;
    turn_.changed = true;
  }

  [[nodiscard]] uint32_t worst_of(uint16_t group, uint16_t partner) const {
    const uint32_t a = rotations_.split_measure(group);
    const uint32_t b = rotations_.split_measure(partner);
    return a > b ? a : b;
  }

  void split_worst() {
    const RankCounts ranks = turn_.find_wanted();
    const uint32_t wanted = ranks.total();
    turn_.counters.groups_waiting = static_cast<uint16_t>(wanted);
    if (wanted == 0) return;
    const auto room = static_cast<uint32_t>(Profile::kGroups - front_.groups.used());
    const uint32_t budget = turn_.begun.left() < room ? turn_.begun.left() : room;
    if constexpr (Profile::kStudyCriteria) {
      if (is_conforming()) return conforming().split_patches(ranks.lowest_within(budget / kMaxPatch).rank);
    }
    split_chosen(ranks.lowest_within(budget));
    if (budget < wanted) (void)turn_.refuse_split();
  }

  /// All above the lowest rank, and of that what there is room for.
  void split_chosen(RankCounts::Lowest lowest) {
    std::array<uint16_t, Profile::kRotationChanges + 1> chosen;  // the last one is scratch
    uint32_t count = 0;
    for (const uint32_t i : bounded<Profile::kGroups>(front_.groups.used(), [] {})) {
      const uint16_t group = front_.groups.live(i);
      const uint32_t rank = turn_.wanted[group];
      const uint32_t is_above = (lowest.rank - rank) >> 31;  // a comparison would become a branch
      const uint32_t fits = all_of(rank == lowest.rank, lowest.room != 0) ? 1u : 0u;
      lowest.room -= fits;
      chosen[count] = group;  // in any case, and overwritten unless it is
      count += is_above | fits;
    }
    for (const uint32_t i : bounded<Profile::kRotationChanges>(count, [] {}))
      (void)turn_.split_one(chosen[i]);
  }

  void begin_joins() {
    if (front_.pairs_at >= front_.groups.used()) return;  // those were joined
    for ([[maybe_unused]] const uint32_t i : bounded<kMostPairs>(pair_slice(), [] {})) {
      const uint16_t group = front_.groups.live(front_.pairs_at);
      const uint16_t other = turn_.calm_sibling(group);
      if (other != kNone && !begin_around(group, other)) return turn_.flag(RemeshFlag::kRotationBudget);
      ++front_.pairs_at;
    }
  }
  /// False when the budget is used up.
  bool begin_around(uint16_t group, uint16_t other) {
    if constexpr (Profile::kStudyCriteria) {
      if (is_conforming()) return conforming().begin_patch(turn_.forest.parent_of(front_.tet[group]));
    }
    if (turn_.begun.left() == 0) return false;
    turn_.begin_join(group, other);
    return true;
  }

  [[nodiscard]] ConformingChanges<Profile, Rotations> conforming() {
    return ConformingChanges<Profile, Rotations>(turn_);
  }

  RotationTurn<Profile, Rotations>& turn_;
  RotationFront<Profile>& front_;
  Rotations& rotations_;
};

}  // namespace palpate
