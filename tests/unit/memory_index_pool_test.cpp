#include "palpate/memory/index_pool.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <set>

#include "support/pool_corruptor.hpp"
#include "support/random.hpp"
#include "support/soak.hpp"

namespace palpate::test {
namespace {

constexpr uint16_t kCapacity = 37;
using Pool = IndexPool<kCapacity>;

Pool cleared() {
  Pool pool;
  pool.clear();
  return pool;
}

TEST(IndexPool, HandsOutAllIndicesInOrderAndThenRefuses) {
  Pool pool = cleared();
  for (uint16_t i = 0; i < kCapacity; ++i) {
    EXPECT_EQ(pool.allocate(), i);
    EXPECT_EQ(pool.live(i), i);
    EXPECT_EQ(pool.used(), i + 1);
  }
  EXPECT_EQ(pool.counters().refused, 0);
  EXPECT_EQ(pool.allocate(), kNone);
  EXPECT_EQ(pool.allocate(), kNone);
  EXPECT_EQ(pool.counters().refused, 2);
  EXPECT_EQ(pool.counters().peak, kCapacity);
  EXPECT_EQ(pool.used(), kCapacity);
  EXPECT_TRUE(pool.is_whole());
}

TEST(IndexPool, RefusesWhatDoesNotFitAtOnce) {
  Pool pool = cleared();
  EXPECT_TRUE(pool.has_room(kCapacity));
  EXPECT_FALSE(pool.has_room(kCapacity + 1));
  EXPECT_EQ(pool.counters().refused, 1);
  for (int i = 0; i < 30; ++i) (void)pool.allocate();
  EXPECT_TRUE(pool.has_room(7));
  EXPECT_FALSE(pool.has_room(8));
  EXPECT_EQ(pool.counters().refused, 2);
  EXPECT_EQ(pool.used(), 30);
}

TEST(IndexPool, CountsRefusalsUpToTheirLimit) {
  Pool pool = cleared();
  for (int i = 0; i < 70000; ++i) (void)pool.has_room(kCapacity + 1);
  EXPECT_EQ(pool.counters().refused, 0xffff);
}

TEST(IndexPool, KnowsWhatIsLive) {
  Pool pool = cleared();
  const uint16_t first = pool.allocate();
  const uint16_t second = pool.allocate();
  EXPECT_TRUE(pool.is_live(second));
  pool.release(second);
  EXPECT_TRUE(pool.is_live(first));
  EXPECT_FALSE(pool.is_live(second));
  EXPECT_EQ(pool.allocate(), second);
  EXPECT_TRUE(pool.is_live(second));
  EXPECT_FALSE(pool.is_live(kNone));
  EXPECT_FALSE(pool.is_live(kCapacity));
}

/// Against a set, over random allocations and releases.
TEST(IndexPool, AgreesWithASet) {
  Random random(41);
  Pool pool = cleared();
  std::set<uint16_t> expected;
  std::size_t peak = 0;
  for (uint32_t i = 0; i < in_soak(10000000u, 100000u); ++i) {
    if (random.below(2) == 0 || expected.empty()) {
      const uint16_t index = pool.allocate();
      ASSERT_EQ(index == kNone, expected.size() == kCapacity);
      const bool is_new = index == kNone || expected.insert(index).second;
      ASSERT_TRUE(is_new);
    } else {
      const uint16_t index = pool.live(random.below(pool.used()));
      ASSERT_EQ(expected.erase(index), 1u);
      pool.release(index);
    }
    peak = std::max(peak, expected.size());
    ASSERT_EQ(pool.used(), expected.size());
    ASSERT_EQ(pool.counters().peak, peak);
    if (i % 100 != 0) continue;
    std::set<uint16_t> live;
    for (uint32_t k = 0; k < pool.used(); ++k) live.insert(pool.live(k));
    ASSERT_EQ(live, expected);
    for (uint16_t k = 0; k < kCapacity; ++k) ASSERT_EQ(pool.is_live(k), expected.count(k) == 1);
    ASSERT_TRUE(pool.is_whole());
  }
}

TEST(IndexPool, ObjectsToDamage) {
  Pool pool = cleared();
  for (int i = 0; i < 5; ++i) (void)pool.allocate();
  const auto objects_to = [&](auto damage) {
    Pool damaged = pool;
    damage(damaged);
    return !damaged.is_whole();
  };
  EXPECT_TRUE(pool.is_whole());
  for (uint32_t i = 0; i < kCapacity; ++i) {
    EXPECT_TRUE(objects_to([i](Pool& p) { PoolCorruptor::order(p, i) ^= 1u; }));
    EXPECT_TRUE(objects_to([i](Pool& p) { PoolCorruptor::order(p, i) = kCapacity; }));
    EXPECT_TRUE(objects_to([i](Pool& p) { PoolCorruptor::order(p, i) = kNone; }));
    EXPECT_TRUE(objects_to([i](Pool& p) { PoolCorruptor::place(p, i) ^= 2u; }));
  }
  EXPECT_TRUE(objects_to([](Pool& p) { PoolCorruptor::used(p) = kCapacity + 1; }));
  EXPECT_TRUE(objects_to([](Pool& p) { PoolCorruptor::counters(p).peak = 4; }));
}

#ifdef PALPATE_CHECKED
TEST(IndexPoolDeathTest, ReleaseOfAFreeIndexStops) {
  Pool pool = cleared();
  EXPECT_DEATH(pool.release(3), "not in use");
}
#endif

}  // namespace
}  // namespace palpate::test
