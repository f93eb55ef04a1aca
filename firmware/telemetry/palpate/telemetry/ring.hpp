// A ring between two that never wait for each other: the tick puts records in, the background takes them out.
// There is one of each (single producer, single consumer), and no lock.
//
//   producer:  if (Record* record = ring.claim()) { fill(*record); ring.publish(); }
//   consumer:  if (const Record* record = ring.oldest()) { use(*record); ring.release(); }
//
// A record is filled and read where it lies. Two counters run freely modulo 2^32: of the records published,
// which only the producer writes, and of those released, which only the consumer writes. A store with release
// and a load with acquire order the record's bytes with them; on a Cortex-M both are plain accesses with a
// barrier.
#pragma once

#include <atomic>

#include "palpate/numeric/platform.hpp"

namespace palpate::telemetry {

template <class Record, uint32_t Capacity>
class Ring {
  static_assert(Capacity >= 2 && (Capacity & (Capacity - 1)) == 0,
                "palpate: a ring's capacity is a power of two, so that its counters may wrap");
  static_assert(std::is_trivially_copyable_v<Record>, "palpate: a record is plain data");
  static_assert(std::atomic<uint32_t>::is_always_lock_free, "palpate: the ring's counters need no lock");

 public:
  static constexpr uint32_t kCapacity = Capacity;

  constexpr Ring() : Ring(0) {}
  /// `first`: where both counters begin. It makes no difference to anybody.
  constexpr explicit Ring(uint32_t first) : published_(first), released_(first), dropped_(0) {}

  /// The producer's: the place of the next record, or nullptr when the ring is full. The record is then
  /// dropped and counted: claim once a record. Straight-line code.
  [[nodiscard]] Record* claim() {
    const uint32_t next = published_.load(std::memory_order_relaxed);
    if (next - released_.load(std::memory_order_acquire) == Capacity) {
      dropped_.store(dropped_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
      return nullptr;
    }
    return &records_[next % Capacity];
  }
  /// The producer's, after claim has given a place.
  void publish() {
    published_.store(published_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }

  /// The consumer's: the record that has waited longest, or nullptr. It stays until release.
  [[nodiscard]] const Record* oldest() const {
    const uint32_t next = released_.load(std::memory_order_relaxed);
    return next == published_.load(std::memory_order_acquire) ? nullptr : &records_[next % Capacity];
  }
  /// The consumer's, after oldest has given a record.
  void release() {
    released_.store(released_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }

  /// Records that found no place since the start, modulo 2^32. Anybody's.
  [[nodiscard]] uint32_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

 private:
  std::array<Record, Capacity> records_{};
  std::atomic<uint32_t> published_, released_, dropped_;
};

}  // namespace palpate::telemetry
