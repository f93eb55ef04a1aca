// A turn of the rotation front: pairs that have blended to their parent's rotation are joined, the worst
// groups are split, calm pairs start to blend. A group sleeps while it blends. For pairs a turn looks at a
// slice of the groups.
//
// Misfits are judged group by group. With the other criteria the front conforms: all tets around an edge are
// split, begin to join, part and are joined in the same turn (front_patch.hpp), which looks at all groups.
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

#include "palpate/mesh/front_patch.hpp"
#include "palpate/remesh/rules.hpp"
#include "palpate/remesh/worst_first.hpp"

namespace palpate {

/// Turns to look at all groups for pairs.
inline constexpr uint32_t kPairTurns = 8;

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

  /// Returns RemeshFlag bits.
  uint32_t run() {
    end_joins();
    split_worst();
    begin_joins();
    return flags_;
  }
  /// Whether the lists of the front need index_groups.
  [[nodiscard]] bool changed() const { return changed_; }

 private:
  struct LeavesTotal {};
  struct BegunTotal {};
  struct EndedTotal {};

  static constexpr uint32_t kPairSlice = (Profile::kGroups + kPairTurns - 1) / kPairTurns;
  static constexpr uint32_t kMostPairs = Profile::kStudyCriteria ? Profile::kGroups : kPairSlice;

  void flag(RemeshFlag which) { flags_ |= static_cast<uint32_t>(which); }
  [[nodiscard]] bool is_conforming() const {
    return Profile::kStudyCriteria && has_conforming_front(rules_.criterion);
  }
  [[nodiscard]] uint8_t level_of(uint16_t group) const { return forest_.level_of(front_.tet[group]); }
  [[nodiscard]] bool is_leaf(uint16_t group) const { return forest_.tet[front_.tet[group]].is_leaf(); }

  /// How many groups a tick looks at for pairs, from pairs_at on.
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

  /// By how much it wants to be split.
  [[nodiscard]] Rank rank(uint16_t group) const {
    const bool may = all_of(!is_leaf(group), is_steady(group));
    if constexpr (Profile::kStudyCriteria) {
      if (!may) return kUnwanted;  // their measures are dear
    }
    const uint32_t measure = rotations_.split_measure(group);
    return rank_of(measure, all_of(may, measure > rules_.split_above));
  }

  /// Ranks all groups by how much they want to be split.
  [[nodiscard]] RankCounts find_wanted() {
    RankCounts ranks;
    for (const uint32_t i : bounded<Profile::kGroups>(front_.groups.used(), [] {})) {
      const uint16_t group = front_.groups.live(i);
      wanted_[group] = rank(group);
      ranks.add(wanted_[group]);
    }
    return ranks;
  }

  void split_worst() {
    const RankCounts ranks = find_wanted();
    const uint32_t wanted = ranks.total();
    counters_.groups_waiting = static_cast<uint16_t>(wanted);
    if (wanted == 0) return;
    const auto room = static_cast<uint32_t>(Profile::kGroups - front_.groups.used());
    const uint32_t budget = begun_.left() < room ? begun_.left() : room;
    if (is_conforming()) return split_patches(ranks.lowest_within(budget / kMaxPatch).rank);
    split_chosen(ranks.lowest_within(budget));
    if (budget < wanted) (void)refuse_split();
  }

  /// All above the lowest rank, and of that what there is room for.
  void split_chosen(RankCounts::Lowest lowest) {
    std::array<uint16_t, Profile::kRotationChanges + 1> chosen;  // the last one is scratch
    uint32_t count = 0;
    for (const uint32_t i : bounded<Profile::kGroups>(front_.groups.used(), [] {})) {
      const uint16_t group = front_.groups.live(i);
      const uint32_t is_above = wanted_[group] > lowest.rank ? 1u : 0u;
      const uint32_t fits = all_of(wanted_[group] == lowest.rank, lowest.room != 0) ? 1u : 0u;
      lowest.room -= fits;
      chosen[count] = group;  // in any case, and overwritten unless it is
      count += is_above | fits;
    }
    for (const uint32_t i : bounded<Profile::kRotationChanges>(count, [] {})) (void)split_one(chosen[i]);
  }

  /// Conforming: for all above that rank, then at it, then below, as long as there is something left.
  void split_patches(uint32_t rank) {
    (void)(split_ranks(rank + 1, kClasses + 1) && split_ranks(rank, rank + 1) && split_ranks(1, rank));
  }
  /// Those from `low` to below `end`. False when nothing more can be split in this tick.
  bool split_ranks(uint32_t low, uint32_t end) {
    for (const uint32_t i : bounded<Profile::kGroups>(front_.groups.used(), [] {})) {
      const uint16_t group = front_.groups.live(i);
      if (wanted_[group] < low || wanted_[group] >= end) continue;
      if (rank(group) == kUnwanted) {
        drop(group);  // its sibling was split: it has nothing left to differ from
      } else if (!split_around(group)) {
        return false;
      }
    }
    return true;
  }

  void drop(uint16_t group) {
    if (wanted_[group] != kUnwanted) --counters_.groups_waiting;
    wanted_[group] = kUnwanted;
  }

  /// The patch of a group, or a coarser one in its way. False when nothing more can be split in this tick.
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

  bool refuse_split() {
    if (begun_.left() == 0) return refuse(RemeshFlag::kRotationBudget);
    (void)front_.groups.has_room(1);  // which counts it
    return refuse(RemeshFlag::kGroups);
  }

  bool split_one(uint16_t group) {
    if (begun_.left() == 0 || front_.groups.used() == Profile::kGroups) return refuse_split();
    if (front_.leaves[group].count > leaves_.left()) return false;
    for ([[maybe_unused]] const uint32_t once : begun_.take(0, 1)) {
      const uint16_t added = split_group(forest_, front_, group, leaves_);
      rotations_.inherit(group, added);
      drop(group);
      wanted_[added] = kUnwanted;
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
    if (front_.pairs_at >= front_.groups.used()) return;  // those were joined
    for ([[maybe_unused]] const uint32_t i : bounded<kMostPairs>(pair_slice(), [] {})) {
      const uint16_t group = front_.groups.live(front_.pairs_at);
      const uint16_t other = calm_sibling(group);
      if (other != kNone && !begin_around(group, other)) return flag(RemeshFlag::kRotationBudget);
      ++front_.pairs_at;
    }
  }
  /// False when the budget is used up.
  bool begin_around(uint16_t group, uint16_t other) {
    if (is_conforming()) return begin_patch(forest_.parent_of(front_.tet[group]));
    if (begun_.left() == 0) return false;
    begin_join(group, other);
    return true;
  }

  /// The sibling's group of a first child's one, where the two are calm; else kNone.
  [[nodiscard]] uint16_t calm_sibling(uint16_t group) const {
    if (!all_of(!is_second_of_pair(front_, group), level_of(group) > rules_.start_level, is_steady(group))) {
      return kNone;
    }
    const uint16_t other = sibling_of(group);
    const bool are_calm =
        other != kNone && is_steady(other) && rotations_.join_measure(group, other) < rules_.join_below;
    return are_calm ? other : kNone;
  }

  [[nodiscard]] bool is_steady(uint16_t group) const {
    return all_of(front_.partner[group] == kNone, !rotations_.is_blending(group));
  }

  /// The pair extracts its parent's rotation from now on, which counts as a change.
  void begin_join(uint16_t group, uint16_t other) {
    for ([[maybe_unused]] const uint32_t once : begun_.take(0, 1)) {
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
      if (!is_first_child(group, patch.tet[i]) || calm_sibling(group) == kNone) return true;
    }
    if (patch.count > begun_.left()) return false;
    for (const uint32_t i : bounded<kMaxPatch>(patch.count, [] {})) {
      const uint16_t group = first_group(patch.tet[i]);
      if (front_.tet[group] != patch.tet[i]) begin_join(group, sibling_of(group));
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
  std::array<Rank, Profile::kGroups> wanted_;  // of each group in use, set by find_wanted
  uint32_t flags_ = 0;
  bool changed_ = false;
};

}  // namespace palpate
