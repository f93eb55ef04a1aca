#include "palpate/mesh/sibling_pairs.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "support/pool_corruptor.hpp"
#include "support/random.hpp"

namespace palpate::test {
namespace {

constexpr uint16_t kMostPairs = 23;
using SomePairs = SiblingPairs<kMostPairs>;

SomePairs no_pairs() {
  SomePairs pairs;
  pairs.clear();
  return pairs;
}

TEST(SiblingPairs, AreHandedOutInOrderAndThenRefused) {
  SomePairs pairs = no_pairs();
  EXPECT_TRUE(pairs.has_room(kMostPairs));
  EXPECT_FALSE(pairs.has_room(kMostPairs + 1));
  for (uint16_t i = 0; i < kMostPairs; ++i) EXPECT_EQ(pairs.allocate(kNone, 0), i);
  EXPECT_EQ(pairs.allocate(7, 3), kNone);
  EXPECT_EQ(pairs.counters().refused, 2);
  EXPECT_EQ(pairs.counters().peak, kMostPairs);
  EXPECT_TRUE(pairs.is_whole());
}

/// Against a stack of free pairs and what each live one was allocated with.
TEST(SiblingPairs, KeepWhatTheyAreGiven) {
  struct Given {
    uint16_t pair, parent;
    uint8_t level;
  };
  Random random(42);
  SomePairs pairs = no_pairs();
  std::vector<uint16_t> free;
  for (uint16_t i = kMostPairs; i > 0; --i) free.push_back(static_cast<uint16_t>(i - 1));
  std::vector<Given> live;
  for (int i = 0; i < 20000; ++i) {
    if (random.below(2) == 0) {
      const bool is_root = random.below(5) == 0;
      const auto parent = is_root ? kNone : static_cast<uint16_t>(random.below(2 * kMostPairs));
      const auto level = static_cast<uint8_t>(random.below(15));
      const uint16_t pair = pairs.allocate(parent, level);
      ASSERT_EQ(pair, free.empty() ? kNone : free.back());
      if (pair == kNone) continue;
      free.pop_back();
      live.push_back({pair, parent, level});
    } else if (!live.empty()) {
      std::swap(live[random.below(static_cast<uint32_t>(live.size()))], live.back());
      pairs.release(live.back().pair);
      ASSERT_FALSE(pairs.is_live(live.back().pair));
      free.push_back(live.back().pair);
      live.pop_back();
    }
    ASSERT_EQ(pairs.used(), live.size());
    for (const Given& given : live) {
      ASSERT_TRUE(pairs.is_live(given.pair));
      ASSERT_EQ(pairs.parent(given.pair), given.parent);
      ASSERT_EQ(pairs.level(given.pair), given.level);
    }
    ASSERT_TRUE(pairs.is_whole());
  }
  EXPECT_FALSE(pairs.is_live(kMostPairs));
  EXPECT_FALSE(pairs.is_live(kNone >> 1));
}

TEST(SiblingPairs, ObjectToDamage) {
  SomePairs pairs = no_pairs();
  for (int i = 0; i < 5; ++i) (void)pairs.allocate(kNone, 0);
  pairs.release(1);
  const auto objects_to = [&](auto damage) {
    SomePairs damaged = pairs;
    damage(damaged);
    return !damaged.is_whole();
  };
  EXPECT_FALSE(objects_to([](SomePairs&) {}));
  for (const uint32_t free : {1u, 5u, 9u, kMostPairs - 1u}) {
    for (const uint16_t wrong : {uint16_t{0}, uint16_t{1}, static_cast<uint16_t>(kMostPairs + 1), kNone})
      EXPECT_TRUE(objects_to([=](SomePairs& p) { PoolCorruptor::parent(p, free) = wrong; })) << free << wrong;
    EXPECT_TRUE(objects_to([=](SomePairs& p) { PoolCorruptor::level(p, free) = 3; }));
  }
  EXPECT_TRUE(objects_to([](SomePairs& p) { PoolCorruptor::level(p, 2) = 0xff; }));
  EXPECT_TRUE(objects_to([](SomePairs& p) { PoolCorruptor::used(p) = 3; }));
  EXPECT_TRUE(objects_to([](SomePairs& p) { PoolCorruptor::counters(p).peak = 3; }));
}

}  // namespace
}  // namespace palpate::test
