// A producer and a consumer at full speed, in two threads: whatever arrives is whole and in order, and what
// does not is counted.
#pragma once

#include <thread>

#include "palpate/telemetry/ring.hpp"

namespace palpate::test {

struct NumberedRecord {
  uint32_t number;
  std::array<uint32_t, 15> words;  // all follow from the number
};

constexpr uint32_t word_of(uint32_t number, uint32_t i) { return (number ^ i) * 2654435761u; }

struct RaceResult {
  uint32_t taken, dropped, torn, out_of_order;
};

/// Of so many records.
template <uint32_t Capacity>
RaceResult race(uint32_t records, uint32_t first) {
  telemetry::Ring<NumberedRecord, Capacity> ring(first);
  std::atomic<bool> is_over{false};
  std::thread producer([&] {
    for (uint32_t number = 1; number <= records; ++number) {
      NumberedRecord* record = ring.claim();
      if (record == nullptr) {
        // So that the other one runs where there is one processor.
        std::this_thread::yield();
        continue;
      }
      record->number = number;
      for (uint32_t i = 0; i < record->words.size(); ++i) record->words[i] = word_of(number, i);
      ring.publish();
    }
    is_over.store(true);
  });
  RaceResult result{};
  uint32_t last = 0;
  for (bool was_over = false;;) {
    const NumberedRecord* record = ring.oldest();
    if (record == nullptr) {
      if (was_over) break;
      was_over = is_over.load();
      std::this_thread::yield();
      continue;
    }
    for (uint32_t i = 0; i < record->words.size(); ++i) {
      result.torn += record->words[i] == word_of(record->number, i) ? 0u : 1u;
    }
    result.out_of_order += record->number > last ? 0u : 1u;
    last = record->number;
    ++result.taken;
    ring.release();
  }
  producer.join();
  result.dropped = ring.dropped();
  return result;
}

}  // namespace palpate::test
