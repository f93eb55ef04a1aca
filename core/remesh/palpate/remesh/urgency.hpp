// How much each leaf wants to be split, renewed in slices of the mesh, and the search for the leaves that
// want it most.
#pragma once

#include "palpate/remesh/stretch.hpp"
#include "palpate/remesh/worst_first.hpp"

namespace palpate {

/// Ticks to renew all urgencies.
inline constexpr uint32_t kSweepTicks = 16;

template <class Profile>
struct Urgencies {
  static constexpr uint8_t kCalm = 0;     // may be merged
  static constexpr uint8_t kNeutral = 1;  // as it should be, or not looked at yet
  static constexpr uint8_t kBarred =
      2;  // wants to be split, but a level in its patch's way may not be passed
  static constexpr uint8_t kWanted = 3;  // and more: wants to be split
  static constexpr uint8_t kMost = 127;
  static constexpr uint8_t kAsleep = 128;  // beside it: not looked at until its next renewal
  static constexpr uint32_t kSlice = (Profile::kLeaves + kSweepTicks - 1) / kSweepTicks;

  std::array<uint8_t, Forest<Profile>::kTets> of;  // of leaf tets
  uint16_t sweep_at;                               // the leaf whose urgency is renewed next
  uint16_t split_at;  // where the search for the most urgent leaf starts: after the last one found
  uint16_t merge_at;  // where the search for calm patches goes on

  [[nodiscard]] uint8_t awake(uint16_t tet) const { return of[tet] & kMost; }

  void clear() {
    for (const uint32_t i : bounded<Forest<Profile>::kTets>(Forest<Profile>::kTets, [] {})) of[i] = kNeutral;
    sweep_at = split_at = merge_at = 0;
  }
};

/// Whether `node` is a vertex of the leaf; kNone never is.
inline bool touches(const Leaf& leaf, uint16_t node) {
  return leaf.node[0] == node || leaf.node[1] == node || leaf.node[2] == node || leaf.node[3] == node;
}

template <class Profile>
StretchMeasure stretch_measure(const Forest<Profile>& forest, const Leaf& leaf, StretchCriterion criterion) {
  if constexpr (Profile::kStudyCriteria) {
    if (criterion == StretchCriterion::kStrainJump) return strain_jump(forest, leaf);
  }
  return criterion == StretchCriterion::kLongestEdge ? longest_edge_stretch(forest, leaf)
                                                     : largest_edge_stretch(forest, leaf);
}

/// `before`: its last one. A leaf that has to wait becomes a little more urgent with every renewal. Leaves at
/// `pinned` go to their finest level.
template <class Profile>
uint8_t urgency_of(const Forest<Profile>& forest, const Leaf& leaf, const StretchRules& rules,
                   uint16_t pinned, uint8_t before) {
  using Urgency = Urgencies<Profile>;
  const LevelRange& levels = rules.levels[leaf.region()];
  const bool may_split = leaf.level() < levels.most;
  if (touches(leaf, pinned)) {
    if (!may_split) return Urgency::kNeutral;
    return before == Urgency::kBarred ? Urgency::kWanted : Urgency::kMost;
  }
  const StretchMeasure stretch = stretch_measure(forest, leaf, rules.criterion);
  if (stretch < rules.merge_below) return leaf.level() > levels.least ? Urgency::kCalm : Urgency::kNeutral;
  if (stretch <= rules.split_above || !may_split) return Urgency::kNeutral;
  if (before == Urgency::kBarred) return Urgency::kWanted;  // behind all others
  const uint32_t excess = class_of(static_cast<uint32_t>(stretch.raw())) -
                          class_of(static_cast<uint32_t>(rules.split_above.raw()));
  const uint32_t fresh = Urgency::kWanted + excess;
  const uint32_t aged = before >= Urgency::kWanted ? before + 1u : fresh;
  const uint32_t urgency = fresh > aged ? fresh : aged;
  return urgency < Urgency::kMost ? static_cast<uint8_t>(urgency) : Urgency::kMost;
}

template <class Profile>
void renew_urgencies(const Forest<Profile>& forest, const StretchRules& rules, uint16_t pinned,
                     Urgencies<Profile>& urgencies) {
  constexpr uint32_t kSlice = Urgencies<Profile>::kSlice;
  const uint32_t count = kSlice < forest.leaf_count ? kSlice : forest.leaf_count;
  for ([[maybe_unused]] const uint32_t i : bounded<kSlice>(count, [] {})) {
    if (urgencies.sweep_at >= forest.leaf_count) urgencies.sweep_at = 0;
    const Leaf& leaf = forest.leaf[urgencies.sweep_at];
    urgencies.of[leaf.tet] = urgency_of(forest, leaf, rules, pinned, urgencies.awake(leaf.tet));
    ++urgencies.sweep_at;
  }
}

/// The most urgent leaf tets, worst first: one a patch of the budget, and some for those that prove blocked.
template <class Profile>
struct MostUrgent {
  static constexpr uint32_t kLooks = Profile::kPatches + 3;
  std::array<uint16_t, kLooks> tet;
  std::array<uint8_t, kLooks> urgency;
  uint32_t count = 0;

  /// What an offer must be more urgent than.
  [[nodiscard]] uint32_t least() const {
    return count == kLooks ? urgency[kLooks - 1] : Urgencies<Profile>::kWanted - 1u;
  }
  /// Behind those that are as urgent; the least urgent one goes when there is no room.
  void offer(uint16_t offered, uint8_t how_urgent) {
    count += count == kLooks ? 0u : 1u;
    uint32_t at = count - 1;
    for ([[maybe_unused]] const uint32_t i : bounded<kLooks - 1>(at, [] {})) {
      if (urgency[at - 1] >= how_urgent) break;
      tet[at] = tet[at - 1];
      urgency[at] = urgency[at - 1];
      --at;
    }
    tet[at] = offered;
    urgency[at] = how_urgent;
  }
};

/// How many leaves want to be split, and how many of them are known not to be able to now.
struct Waiting {
  uint32_t all, blocked;
};

/// Goes through all leaves, from split_at on, so that equally urgent ones take turns. Leaves that are asleep
/// or that `is_blocked(leaf)` are passed over. Where each is more urgent than the ones before, the search
/// takes no more than kOffers; those behind have their turn in a later tick.
template <class Profile, class IsBlocked>
Waiting find_most_urgent(const Forest<Profile>& forest, Urgencies<Profile>& urgencies, IsBlocked is_blocked,
                         MostUrgent<Profile>& wanted) {
  using Urgency = Urgencies<Profile>;
  constexpr uint32_t kOffers = 8 * MostUrgent<Profile>::kLooks;
  auto offers = bounded_total<kOffers>([] {});
  Waiting waiting{0, 0};
  if (urgencies.split_at >= forest.leaf_count) urgencies.split_at = 0;
  uint32_t at = urgencies.split_at;
  uint32_t least = wanted.least();
  for ([[maybe_unused]] const uint32_t i : bounded<Profile::kLeaves>(forest.leaf_count, [] {})) {
    const Leaf& leaf = forest.leaf[at];
    const uint8_t urgency = urgencies.of[leaf.tet];
    const uint32_t is_wanted = urgency >= Urgency::kWanted ? 1u : 0u;
    const uint32_t is_passed_over = (urgency > Urgency::kMost ? 1u : 0u) | is_blocked(leaf);
    waiting.all += is_wanted;
    waiting.blocked += is_wanted & is_passed_over;
    at = at + 1 == forest.leaf_count ? 0 : at + 1;
    if (is_passed_over != 0 || urgency <= least || offers.left() == 0) continue;
    for ([[maybe_unused]] const uint32_t once : offers.take(0, 1)) wanted.offer(leaf.tet, urgency);
    least = wanted.least();
  }
  return waiting;
}

}  // namespace palpate
