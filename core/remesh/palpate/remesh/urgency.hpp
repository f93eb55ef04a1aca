// How much each leaf wants to be split, renewed in slices of the mesh, and the search for the leaves that
// want it most.
#pragma once

#include "palpate/remesh/stretch.hpp"
#include "palpate/remesh/worst_first.hpp"

namespace palpate {

/// Slices in which all urgencies are renewed.
inline constexpr uint32_t kSweepSlices = 8;

/// How many leaves want to be split, and how many of them are known not to be able to now.
struct Waiting {
  uint32_t all, blocked;
};

template <class Profile>
class MostUrgent;

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

  static constexpr uint32_t kBlock = 16;  // leaves that the search looks at together
  static constexpr uint32_t kBlocks = (Profile::kLeaves + kBlock - 1) / kBlock;

  alignas(uint32_t) std::array<uint8_t, std::size_t{kBlock} * kBlocks> of;  // by leaf; kNeutral behind them
  uint16_t sweep_at;  // the leaf whose urgency is renewed next
  uint16_t split_at;  // the block where the search for the most urgent ones starts: behind the last found
  uint16_t merge_at;  // where the search for calm patches goes on
  MostUrgent<Profile> chosen;  // to be split in the next turn of the mesh
  Waiting waiting;             // when they were chosen, and what has changed since

  [[nodiscard]] uint8_t awake(uint32_t leaf) const { return of[leaf] & kMost; }
  /// A merge has left a gap among the leaves, which the last one fills, from behind all leaves now.
  void move(uint32_t gap, uint32_t from) {
    of[gap] = of[from];
    of[from] = kNeutral;
  }

  void clear() {
    for (const uint32_t i : bounded<kBlock * kBlocks>(kBlock * kBlocks, [] {})) of[i] = kNeutral;
    sweep_at = split_at = merge_at = 0;
    chosen.clear();
    waiting.all = waiting.blocked = 0;
  }
};

/// Urgencies of four leaves side by side in a word, the first one lowest, all looked at together.
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
  [[nodiscard]] uint32_t awake() const { return ~all_ & kTops; }

 private:
  static constexpr uint32_t kTops = 0x80808080;
  static constexpr uint32_t kOnes = 0x01010101;
  uint32_t all_;
};

/// Top bits of four words of FourUrgencies.
struct SixteenTops {
  uint32_t a, b, c, d;

  [[nodiscard]] constexpr bool any() const { return (a | b | c | d) != 0; }
  [[nodiscard]] constexpr uint32_t count() const {
    return ((a >> 7) + (b >> 7) + (c >> 7) + (d >> 7)) * 0x01010101u >> 24;
  }
  /// A bit for each of the sixteen, the first one lowest.
  [[nodiscard]] constexpr uint32_t bits() const {
    return side_by_side(a) | side_by_side(b) << 4 | side_by_side(c) << 8 | side_by_side(d) << 12;
  }
  /// Which of these bits is the first; there must be one.
  static constexpr uint32_t first(uint32_t bits) {
    return 31u - static_cast<uint32_t>(leading_zeros(bits & (0u - bits)));
  }
  static constexpr uint32_t without_first(uint32_t bits) { return bits & (bits - 1); }

 private:
  /// Bits 0, 8, 16 and 24 meet in 21 .. 24.
  static constexpr uint32_t side_by_side(uint32_t tops) { return ((tops >> 7) * 0x00204081u >> 21) & 15u; }
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

/// Of the rules, what all leaves have in common.
struct StretchLimits {
  explicit StretchLimits(const StretchRules& rules)
      : criterion(rules.criterion),
        split_above(rules.split_above),
        merge_below(rules.merge_below),
        class_of_split(class_of(static_cast<uint32_t>(rules.split_above.raw()))) {}
  StretchCriterion criterion;
  StretchMeasure split_above, merge_below;
  uint32_t class_of_split;
};

/// `before`: its last one. A leaf that has to wait becomes a little more urgent with every renewal. Leaves at
/// `pinned` go to their finest level.
template <class Profile>
PALPATE_ALWAYS_INLINE uint8_t urgency_of(const Forest<Profile>& forest, const Leaf& leaf,
                                         const StretchRules& rules, const StretchLimits& limits,
                                         uint16_t pinned, uint8_t before) {
  using Urgency = Urgencies<Profile>;
  const LevelRange& levels = rules.levels[leaf.region()];
  const bool may_split = leaf.level() < levels.most;
  const bool is_pinned = touches(leaf, pinned);
  const StretchMeasure stretch = stretch_measure(forest, leaf, limits.criterion);
  const bool is_calm = stretch < limits.merge_below;
  const bool is_wanted = all_of(may_split, any_of(is_pinned, all_of(!is_calm, stretch > limits.split_above)));
  const uint32_t excess = class_of(static_cast<uint32_t>(stretch.raw())) - limits.class_of_split;
  // All is computed, and chosen from in the end.
  const uint32_t fresh = is_pinned ? Urgency::kMost : Urgency::kWanted + excess;
  const uint32_t aged = before >= Urgency::kWanted ? before + 1u : fresh;
  const uint32_t most = fresh > aged ? fresh : aged;
  const uint32_t limited = most < Urgency::kMost ? most : Urgency::kMost;
  const uint32_t split = before == Urgency::kBarred ? Urgency::kWanted : limited;  // behind all others
  const bool is_merged = all_of(is_calm, !is_pinned, leaf.level() > levels.least);
  const uint32_t rest = is_merged ? Urgency::kCalm : Urgency::kNeutral;
  return static_cast<uint8_t>(is_wanted ? split : rest);
}

template <class Profile>
PALPATE_NOINLINE void renew_urgencies(const Forest<Profile>& forest, const StretchRules& rules,
                                      uint16_t pinned, Urgencies<Profile>& urgencies) {
  constexpr uint32_t kSlice = Urgencies<Profile>::kSlice;
  const StretchLimits limits(rules);
  const uint32_t leaves = forest.leaf_count;
  uint32_t at = urgencies.sweep_at;
  for ([[maybe_unused]] const uint32_t i : bounded<kSlice>(kSlice < leaves ? kSlice : leaves, [] {})) {
    at = at < leaves ? at : 0;
    urgencies.of[at] = urgency_of(forest, forest.leaf[at], rules, limits, pinned, urgencies.awake(at));
    ++at;
  }
  urgencies.sweep_at = static_cast<uint16_t>(at);
}

/// The most urgent leaves, worst first: one a patch of the budget, and some for those that prove blocked.
template <class Profile>
class MostUrgent {
 public:
  static constexpr uint32_t kLooks = Profile::kPatches + 3;
  /// What is offered in one search.
  static constexpr uint32_t kOffers = 8 * kLooks;

  void clear() {
    for (const uint32_t i : bounded<kLooks>(kLooks, [] {})) places_[i] = kNobody;
    offers_ = 0;
  }
  [[nodiscard]] uint32_t count() const { return offers_ < kLooks ? offers_ : kLooks; }
  [[nodiscard]] uint16_t leaf(uint32_t i) const { return static_cast<uint16_t>(places_[i]); }
  [[nodiscard]] uint8_t urgency(uint32_t i) const { return static_cast<uint8_t>(places_[i] >> kUrgencyAt); }
  /// What an offer must be more urgent than.
  [[nodiscard]] uint32_t least() const { return places_[kLooks - 1] >> kUrgencyAt; }
  /// Behind those that are as urgent; the least urgent one goes when there is no room.
  void offer(uint32_t leaf, uint32_t urgency) {
    uint32_t carried = urgency << kUrgencyAt | (kOffers - offers_) << kTurnAt | leaf;
#pragma GCC unroll 8
    for (const uint32_t i : bounded<kLooks>(kLooks, [] {})) {
      const uint32_t place = places_[i];
      places_[i] = place > carried ? place : carried;
      carried = place > carried ? carried : place;
    }
    ++offers_;
  }

 private:
  static constexpr uint32_t kTurnAt = 16;
  static constexpr uint32_t kUrgencyAt = 24;
  static constexpr uint32_t kNobody = (Urgencies<Profile>::kWanted - 1u) << kUrgencyAt;
  static_assert(kOffers < 1u << (kUrgencyAt - kTurnAt));
  std::array<uint32_t, kLooks> places_;  // the urgency above its turn, the first one highest, and the leaf
  uint32_t offers_;
};

/// What the search takes, where each is more urgent than the ones before, and what it looks at closely.
template <class Profile>
inline constexpr uint32_t kMostOffers = MostUrgent<Profile>::kOffers;
template <class Profile>
inline constexpr uint32_t kMostLooks = kMostOffers<Profile> + Profile::kLeaves / 8;

/// Goes through all leaves, from split_at on, so that equally urgent ones take turns, and looks closely at
/// those that are more urgent than the ones in blocks before. Leaves that are asleep or that
/// `is_blocked(leaf)` are passed over. Looks and offers are limited: those behind have their turn in a later
/// tick.
template <class Profile, class IsBlocked>
Waiting find_most_urgent(const Forest<Profile>& forest, Urgencies<Profile>& urgencies, IsBlocked is_blocked,
                         MostUrgent<Profile>& wanted) {
  using Urgency = Urgencies<Profile>;
  wanted.clear();
  auto looks = bounded_total<kMostLooks<Profile>>([] {});
  auto offers = bounded_total<kMostOffers<Profile>>([] {});
  Waiting waiting{0, 0};
  uint32_t at = urgencies.split_at < Urgency::kBlocks ? urgencies.split_at : 0u;
  uint32_t looked_at = at;
  uint32_t closer = FourUrgencies::each(wanted.least() + 1);  // what is worth a closer look
  for ([[maybe_unused]] const uint32_t i : bounded<Urgency::kBlocks>(Urgency::kBlocks, [] {})) {
    const FourUrgencies a(urgencies, 4 * at), b(urgencies, 4 * at + 1), c(urgencies, 4 * at + 2),
        d(urgencies, 4 * at + 3);
    constexpr uint32_t kEachWanted = FourUrgencies::each(Urgency::kWanted);
    const SixteenTops are_wanted{a.reach(kEachWanted), b.reach(kEachWanted), c.reach(kEachWanted),
                                 d.reach(kEachWanted)};
    const SixteenTops sleep{are_wanted.a & a.asleep(), are_wanted.b & b.asleep(), are_wanted.c & c.asleep(),
                            are_wanted.d & d.asleep()};
    waiting.all += are_wanted.count();
    waiting.blocked += sleep.count();
    const SixteenTops near{a.reach(closer) & a.awake(), b.reach(closer) & b.awake(),
                           c.reach(closer) & c.awake(), d.reach(closer) & d.awake()};
    const uint32_t first = Urgency::kBlock * at;
    const uint32_t here = at;
    at = at + 1 == Urgency::kBlocks ? 0 : at + 1;
    if (!near.any() || looks.left() == 0) continue;
    looked_at = here;
    const uint32_t count = near.count();
    uint32_t left = near.bits();
    for ([[maybe_unused]] const uint32_t look : looks.take(0, count < looks.left() ? count : looks.left())) {
      const uint32_t place = first + SixteenTops::first(left);
      left = SixteenTops::without_first(left);
      const uint32_t blocked = is_blocked(forest.leaf[place]);
      waiting.blocked += blocked;
      const uint32_t urgency = urgencies.of[place];
      if (!all_of(blocked == 0, urgency > wanted.least(), offers.left() != 0)) continue;
      for ([[maybe_unused]] const uint32_t once : offers.take(0, 1)) wanted.offer(place, urgency);
      closer = FourUrgencies::each((offers.left() == 0 ? Urgency::kMost : wanted.least()) + 1u);
    }
  }
  if (looks.left() == 0) urgencies.split_at = static_cast<uint16_t>(looked_at);
  return waiting;
}

}  // namespace palpate
