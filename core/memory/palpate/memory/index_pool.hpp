// A pool of indices 0 .. Capacity-1 with O(1) allocate and release, and no memory of its own to hand out:
// owners keep their data in plain arrays beside it. Live indices are always dense in live(0) ..
// live(used()-1), so loops over what is alive need no test. All calls take constant time.
#pragma once

#include "palpate/numeric/bounded.hpp"

namespace palpate {

inline constexpr uint16_t kNone = 0xffff;

struct PoolCounters {
  uint16_t peak;     // most indices in use at once
  uint16_t refused;  // allocations that found the pool full (saturates)

  /// Whether `count` more fit beside those in use; if not, that is counted as one refusal.
  [[nodiscard]] bool has_room(uint32_t used, uint32_t count, uint32_t capacity) {
    const bool fits = used + count <= capacity;
    if (!fits) refused = refused < 0xffff ? static_cast<uint16_t>(refused + 1u) : refused;
    return fits;
  }
  void note(uint16_t used) { peak = used > peak ? used : peak; }
};

template <uint16_t Capacity>
class IndexPool {
  static_assert(Capacity < kNone, "palpate: a pool needs an index to spare for kNone");

 public:
  static constexpr uint16_t kCapacity = Capacity;

  /// Everything free; indices are then handed out in the order 0, 1, 2, ...
  void clear() {
    for (const uint32_t i : bounded<Capacity>(Capacity, [] {})) {
      order_[i] = static_cast<uint16_t>(i);
      place_[i] = static_cast<uint16_t>(i);
    }
    used_ = 0;
    counters_ = PoolCounters{0, 0};
  }

  /// Whether `count` more indices are free; if not, that is counted as one refusal.
  [[nodiscard]] bool has_room(uint32_t count) { return counters_.has_room(used_, count, Capacity); }

  /// A free index, or kNone (counted as refused) when all are in use.
  [[nodiscard]] uint16_t allocate() { return has_room(1) ? take() : kNone; }

  /// A free index, where has_room was asked.
  [[nodiscard]] uint16_t take() {
    check(used_ < Capacity, "took an index from a full pool");
    const uint16_t index = order_[used_];
    ++used_;
    counters_.note(used_);
    return index;
  }

  /// `index` must be live.
  void release(uint16_t index) {
    check(is_live(index), "released an index that is not in use");
    --used_;
    const uint16_t hole = place_[index];
    const uint16_t moved = order_[used_];
    order_[hole] = moved;
    place_[moved] = hole;
    order_[used_] = index;
    place_[index] = used_;
  }

  [[nodiscard]] bool is_live(uint16_t index) const { return index < Capacity && place_[index] < used_; }
  /// The at-th live index; release moves the last one into the gap.
  [[nodiscard]] uint16_t live(uint32_t at) const { return order_[at]; }
  [[nodiscard]] uint16_t used() const { return used_; }
  [[nodiscard]] const PoolCounters& counters() const { return counters_; }

  /// For invariant checks: order and place are inverse permutations.
  [[nodiscard]] bool is_whole() const {
    bool whole = used_ <= Capacity && counters_.peak >= used_;
    for (const uint32_t i : bounded<Capacity>(Capacity, [] {})) {
      whole = whole && order_[i] < Capacity && place_[order_[i]] == i;
    }
    return whole;
  }

 private:
  friend struct PoolCorruptor;  // tests damage a pool through it, to see is_whole object

  std::array<uint16_t, Capacity> order_;  // live indices first, then free ones
  std::array<uint16_t, Capacity> place_;  // where each index stands in order_
  uint16_t used_;
  PoolCounters counters_;
};

}  // namespace palpate
