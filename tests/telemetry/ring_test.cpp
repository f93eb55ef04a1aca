// The ring against a queue, whatever the order of the calls.
#include "palpate/telemetry/ring.hpp"

#include <gtest/gtest.h>

#include <deque>

#include "support/random.hpp"
#include "support/soak.hpp"

namespace palpate::test {
namespace {

using telemetry::Ring;

struct Number {
  uint32_t value;
};

/// The same calls to both, one at a time.
template <uint32_t Capacity>
class RingBesideQueue {
 public:
  explicit RingBesideQueue(uint32_t first) : ring_(first) {}

  void push() {
    ++next_;
    Number* place = ring_.claim();
    const bool has_room = queue_.size() < Capacity;
    ASSERT_EQ(place != nullptr, has_room);
    if (!has_room) {
      ++dropped_;
    } else {
      // Not seen before it is published.
      const Number* oldest = ring_.oldest();
      place->value = next_;
      ASSERT_EQ(ring_.oldest(), oldest);
      ring_.publish();
      queue_.push_back(next_);
    }
    ASSERT_EQ(ring_.dropped(), dropped_);
  }
  void pop() {
    const Number* oldest = ring_.oldest();
    ASSERT_EQ(oldest != nullptr, !queue_.empty());
    if (oldest == nullptr) return;
    ASSERT_EQ(oldest->value, queue_.front());
    // It stays until it is released.
    ASSERT_EQ(ring_.oldest(), oldest);
    ring_.release();
    queue_.pop_front();
    ++taken_;
  }
  [[nodiscard]] uint32_t taken() const { return taken_; }
  [[nodiscard]] uint32_t dropped() const { return dropped_; }

 private:
  Ring<Number, Capacity> ring_;
  std::deque<uint32_t> queue_;
  uint32_t next_ = 0, dropped_ = 0, taken_ = 0;
};

/// Runs of pushes and pops, so that the ring is full, empty and between.
template <uint32_t Capacity>
void expect_queue(uint64_t seed, uint32_t first) {
  Random random(seed);
  RingBesideQueue<Capacity> both(first);
  for (uint32_t round = 0; round < in_soak(1000000u, 5000u); ++round) {
    const bool is_push = random.below(2) == 0;
    const uint32_t calls = random.below(2 * Capacity);
    for (uint32_t i = 0; i < calls; ++i) {
      if (is_push) {
        both.push();
      } else {
        both.pop();
      }
      if (testing::Test::HasFatalFailure()) return;
    }
  }
  EXPECT_GT(both.taken(), 1000u);
  EXPECT_GT(both.dropped(), 100u);
}

TEST(Ring, IsAQueueThatDropsWhatIsTooMuch) {
  expect_queue<2>(41, 0);
  expect_queue<16>(42, 0);
  expect_queue<64>(43, 0);
}

/// The counters run through 2^32 within the first calls.
TEST(Ring, PassesTheEndOfItsCounters) {
  for (uint32_t before = 0; before <= 20; ++before) expect_queue<8>(44 + before, 0u - before);
}

TEST(Ring, BeginsEmpty) {
  const Ring<Number, 4> ring;
  EXPECT_EQ(ring.oldest(), nullptr);
  EXPECT_EQ(ring.dropped(), 0u);
}

/// A full ring keeps what it has: the newest is what is dropped.
TEST(Ring, DropsTheNewest) {
  Ring<Number, 4> ring;
  for (uint32_t i = 0; i < 7; ++i) {
    if (Number* place = ring.claim()) {
      place->value = i;
      ring.publish();
    }
  }
  EXPECT_EQ(ring.dropped(), 3u);
  for (uint32_t i = 0; i < 4; ++i, ring.release()) {
    ASSERT_NE(ring.oldest(), nullptr);
    EXPECT_EQ(ring.oldest()->value, i);
  }
  EXPECT_EQ(ring.oldest(), nullptr);
}

}  // namespace
}  // namespace palpate::test
