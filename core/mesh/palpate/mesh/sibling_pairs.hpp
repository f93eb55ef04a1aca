// Tets come in sibling pairs, (2p, 2p + 1): what is the same for both of them, and which pairs are in use.
// While a pair is free, the place of its parent holds the next free one. All calls but is_whole and clear
// take constant time; the pair that was released last is allocated first.
#pragma once

#include "palpate/memory/index_pool.hpp"

namespace palpate {

template <uint16_t Capacity>
class SiblingPairs {
  static_assert(2 * Capacity < kNone, "palpate: a parent is a tet or kNone");

 public:
  static constexpr uint16_t kCapacity = Capacity;

  /// Everything free; pairs are then handed out in the order 0, 1, 2, ...
  void clear() {
    for (const uint32_t i : bounded<Capacity>(Capacity, [] {})) {
      parent_or_next_[i] = static_cast<uint16_t>(i + 1);
      level_[i] = kFree;
    }
    free_ = 0;
    used_ = 0;
    counters_ = PoolCounters{0, 0};
  }

  /// Whether `count` more pairs are free; if not, that is counted as one refusal.
  [[nodiscard]] bool has_room(uint32_t count) { return counters_.has_room(used_, count, Capacity); }

  /// The children of `parent` at `level`; of two roots, which come in pairs too, kNone at level 0. kNone
  /// (counted as refused) when all pairs are in use.
  [[nodiscard]] uint16_t allocate(uint16_t parent, uint8_t level) {
    return has_room(1) ? take(parent, level) : kNone;
  }

  /// The same, where has_room was asked.
  [[nodiscard]] uint16_t take(uint16_t parent, uint8_t level) {
    check(used_ < Capacity, "took a pair where none is free");
    const uint16_t pair = free_;
    free_ = parent_or_next_[pair];
    parent_or_next_[pair] = parent;
    level_[pair] = level;
    ++used_;
    counters_.note(used_);
    return pair;
  }

  /// `pair` must be live.
  void release(uint16_t pair) {
    check(is_live(pair), "released a pair that is not in use");
    parent_or_next_[pair] = free_;
    level_[pair] = kFree;
    free_ = pair;
    --used_;
  }

  [[nodiscard]] bool is_live(uint32_t pair) const { return pair < Capacity && level_[pair] != kFree; }
  /// kNone for roots.
  [[nodiscard]] uint16_t parent(uint32_t pair) const { return parent_or_next_[pair]; }
  [[nodiscard]] uint8_t level(uint32_t pair) const { return level_[pair]; }
  [[nodiscard]] uint16_t used() const { return used_; }
  [[nodiscard]] const PoolCounters& counters() const { return counters_; }

  /// For invariant checks: what is not in use is in the list of free pairs, each once. O(Capacity).
  [[nodiscard]] bool is_whole() const {
    uint32_t live = 0;
    for (const uint32_t i : bounded<Capacity>(Capacity, [] {})) live += is_live(i) ? 1u : 0u;
    if (live != used_ || counters_.peak < used_) return false;
    uint32_t next = free_;
    for ([[maybe_unused]] const uint32_t i : bounded<Capacity>(Capacity - live, [] {})) {
      if (next >= Capacity || is_live(next)) return false;
      next = parent_or_next_[next];
    }
    return next == Capacity;  // a list that came back to where it was would not end
  }

 private:
  friend struct PoolCorruptor;  // tests damage it, to see is_whole object
  static constexpr uint8_t kFree = 0xff;

  std::array<uint16_t, Capacity> parent_or_next_;
  std::array<uint8_t, Capacity> level_;  // kFree while the pair is not in use
  uint16_t free_;                        // the first free pair; the last one's next is Capacity
  uint16_t used_;
  PoolCounters counters_;
};

}  // namespace palpate
