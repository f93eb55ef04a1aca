// How much each leaf wants to be split, renewed in slices of the mesh, and the search for the leaves that
// want it most.
#pragma once

#include "palpate/remesh/stretch.hpp"
#include "palpate/remesh/worst_first.hpp"

namespace palpate {

/// Slices in which all urgencies are renewed.
inline constexpr uint32_t kSweepSlices = 8;

template <class Profile>
struct Urgencies {
  static constexpr uint8_t kCalm = 0;     // may be merged
  static constexpr uint8_t kNeutral = 1;  // as it should be, or not looked at yet
  static constexpr uint8_t kBarred =
      2;  // wants to be split, but a level in its patch's way may not be passed
  static constexpr uint8_t kWanted = 3;  // and more: wants to be split
  static constexpr uint8_t kMost = 127;
  static constexpr uint8_t kAsleep = 128;  // beside it: not looked at until its next renewal
  static constexpr uint32_t kSlice = (Profile::kLeaves + kSweepSlices - 1) / kSweepSlices;

  static constexpr uint32_t kFours = (Forest<Profile>::kTets + 3) / 4;

  alignas(uint32_t) std::array<uint8_t, std::size_t{4} * kFours> of;  // of leaf tets; no other one is wanted
  uint16_t sweep_at;  // the leaf whose urgency is renewed next
  uint16_t split_at;  // the four tets where the search for the most urgent ones starts: behind the last found
  uint16_t merge_at;  // where the search for calm patches goes on

  [[nodiscard]] uint8_t awake(uint16_t tet) const { return of[tet] & kMost; }

  void clear() {
    for (const uint32_t i : bounded<4 * kFours>(4 * kFours, [] {})) of[i] = kNeutral;
    sweep_at = split_at = merge_at = 0;
  }
};

/// Urgencies of four tets side by side in a word, the first one lowest, all looked at together.
class FourUrgencies {
 public:
  template <class Profile>
  FourUrgencies(const Urgencies<Profile>& urgencies, uint32_t at) {
    const uint8_t* of = &urgencies.of[4 * at];
    static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
    __builtin_memcpy(&all_, __builtin_assume_aligned(of, sizeof all_), sizeof all_);
  }
  /// `urgency` for each of four.
  static constexpr uint32_t each(uint32_t urgency) { return urgency * kOnes; }
  /// A top bit for each that is at least as urgent, below kMost, asleep or not.
  [[nodiscard]] uint32_t reach(uint32_t each_urgency) const {
    return ((all_ & ~kTops) + (kTops - each_urgency)) & kTops;
  }
  [[nodiscard]] uint32_t asleep() const { return all_ & kTops; }

  static constexpr uint32_t count(uint32_t tops) { return (tops >> 7) * kOnes >> 24; }
  /// Which of the four has the lowest of these bits; there must be one.
  static constexpr uint32_t first(uint32_t tops) {
    return static_cast<uint32_t>(31 - leading_zeros(tops & (0u - tops))) / 8;
  }
  static constexpr uint32_t without_first(uint32_t tops) { return tops & (tops - 1); }

 private:
  static constexpr uint32_t kTops = 0x80808080;
  static constexpr uint32_t kOnes = 0x01010101;
  uint32_t all_;
};

/// Whether `node` is a vertex of the leaf; kNone never is.
inline bool touches(const Leaf& leaf, uint16_t node) {
  return any_of(leaf.node[0] == node, leaf.node[1] == node, leaf.node[2] == node, leaf.node[3] == node);
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
class MostUrgent {
 public:
  static constexpr uint32_t kLooks = Profile::kPatches + 3;

  MostUrgent() {
    for (const uint32_t i : bounded<kLooks>(kLooks, [] {})) places_[i] = kNobody;
  }
  [[nodiscard]] uint32_t count() const { return count_; }
  [[nodiscard]] uint16_t tet(uint32_t i) const { return static_cast<uint16_t>(places_[i]); }
  [[nodiscard]] uint8_t urgency(uint32_t i) const { return static_cast<uint8_t>(places_[i] >> 16); }
  /// What an offer must be more urgent than.
  [[nodiscard]] uint32_t least() const { return places_[kLooks - 1] >> 16; }
  /// Behind those that are as urgent; the least urgent one goes when there is no room.
  void offer(uint16_t tet, uint8_t urgency) {
    uint32_t carried = uint32_t{urgency} << 16 | tet;
    bool is_ahead = false;
#pragma GCC unroll 8
    for (const uint32_t i : bounded<kLooks>(kLooks, [] {})) {
      const uint32_t place = places_[i];
      is_ahead = any_of(is_ahead, carried > (place | 0xffffu));
      places_[i] = is_ahead ? carried : place;
      carried = is_ahead ? place : carried;
    }
    count_ += count_ == kLooks ? 0u : 1u;
  }

 private:
  static constexpr uint32_t kNobody = (Urgencies<Profile>::kWanted - 1u) << 16;
  std::array<uint32_t, kLooks> places_;  // the urgency above the tet
  uint32_t count_ = 0;
};

/// How many leaves want to be split, and how many of them are known not to be able to now.
struct Waiting {
  uint32_t all, blocked;
};

/// What the search takes, where each is more urgent than the ones before, and what it looks at closely.
template <class Profile>
inline constexpr uint32_t kMostOffers = 8 * MostUrgent<Profile>::kLooks;
template <class Profile>
inline constexpr uint32_t kMostLooks = kMostOffers<Profile> + Profile::kLeaves / 8;

/// Goes through all tets, from split_at on, so that equally urgent ones take turns, and looks closely at
/// those that are more urgent than the ones before. Leaves that are asleep or that `is_blocked(leaf)` are
/// passed over. Looks and offers are limited: those behind have their turn in a later tick.
template <class Profile, class IsBlocked>
Waiting find_most_urgent(const Forest<Profile>& forest, Urgencies<Profile>& urgencies, IsBlocked is_blocked,
                         MostUrgent<Profile>& wanted) {
  using Urgency = Urgencies<Profile>;
  auto looks = bounded_total<kMostLooks<Profile>>([] {});
  auto offers = bounded_total<kMostOffers<Profile>>([] {});
  Waiting waiting{0, 0};
  uint32_t at = urgencies.split_at < Urgency::kFours ? urgencies.split_at : 0u;
  uint32_t looked_at = at;
  uint32_t closer = FourUrgencies::each(wanted.least() + 1);  // what is worth a closer look
  for ([[maybe_unused]] const uint32_t i : bounded<Urgency::kFours>(Urgency::kFours, [] {})) {
    const FourUrgencies four(urgencies, at);
    const uint32_t are_wanted = four.reach(FourUrgencies::each(Urgency::kWanted));
    waiting.all += FourUrgencies::count(are_wanted);
    waiting.blocked += FourUrgencies::count(are_wanted & four.asleep());
    uint32_t left = four.reach(closer) & ~four.asleep();
    const uint32_t count = FourUrgencies::count(left);
    for ([[maybe_unused]] const uint32_t look : looks.take(0, count < looks.left() ? count : looks.left())) {
      const auto tet = static_cast<uint16_t>(4 * at + FourUrgencies::first(left));
      left = FourUrgencies::without_first(left);
      looked_at = at;
      const uint32_t blocked = is_blocked(forest.leaf_of(tet));
      waiting.blocked += blocked;
      const uint8_t urgency = urgencies.of[tet];
      if (all_of(blocked == 0, urgency > wanted.least(), offers.left() != 0)) {
        for ([[maybe_unused]] const uint32_t once : offers.take(0, 1)) wanted.offer(tet, urgency);
        closer = FourUrgencies::each(wanted.least() + 1);
      }
      const bool is_over = any_of(looks.left() == 0, offers.left() == 0);
      closer = is_over ? FourUrgencies::each(Urgency::kMost + 1) : closer;
    }
    at = at + 1 == Urgency::kFours ? 0 : at + 1;
  }
  if (looks.left() == 0) urgencies.split_at = static_cast<uint16_t>(looked_at);
  return waiting;
}

}  // namespace palpate
