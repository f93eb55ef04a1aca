#include "palpate/remesh/urgency.hpp"

#include <gtest/gtest.h>

#include "support/forests.hpp"

namespace palpate::test {
namespace {

using Urgency = Urgencies<Bar>;
using Wanted = MostUrgent<Bar>;

const auto kNobody = [](const Leaf&) { return 0u; };

class MostUrgentLeaves : public testing::Test {
 protected:
  MostUrgentLeaves() {
    EXPECT_EQ(refine_uniformly(*forest_, 3), MeshStatus::kDone);
    urgencies_->clear();
    wanted_.clear();
  }
  uint8_t& urgency(uint32_t leaf) { return urgencies_->of[leaf]; }

  std::unique_ptr<Forest<Bar>> forest_ = roots_of<Bar>(bar_block());
  std::unique_ptr<Urgency> urgencies_ = std::make_unique<Urgency>();
  Wanted wanted_;
};

TEST_F(MostUrgentLeaves, AreTheMostUrgentInOrder) {
  for (uint32_t i = 0; i < forest_->leaf_count; ++i) {
    urgency(i) = static_cast<uint8_t>(Urgency::kWanted + i * 37 % 100);
  }
  const Waiting waiting = find_most_urgent(*forest_, *urgencies_, kNobody, wanted_);
  EXPECT_EQ(waiting.all, forest_->leaf_count);
  EXPECT_EQ(waiting.blocked, 0u);
  ASSERT_EQ(wanted_.count(), Wanted::kLooks);
  std::vector<uint8_t> all;
  for (uint32_t i = 0; i < forest_->leaf_count; ++i) all.push_back(urgency(i));
  std::sort(all.rbegin(), all.rend());
  for (uint32_t i = 0; i < Wanted::kLooks; ++i) {
    EXPECT_EQ(wanted_.urgency(i), all[i]);
    EXPECT_EQ(urgency(wanted_.leaf(i)), all[i]);
  }
}

TEST_F(MostUrgentLeaves, AreNeitherAsleepNorBlocked) {
  for (uint32_t i = 0; i < 4; ++i) urgency(i) = Urgency::kMost;
  urgency(1) |= Urgency::kAsleep;
  const auto is_second = [&](const Leaf& leaf) { return leaf.tet == forest_->leaf[2].tet ? 1u : 0u; };
  const Waiting waiting = find_most_urgent(*forest_, *urgencies_, is_second, wanted_);
  EXPECT_EQ(waiting.all, 4u);
  EXPECT_EQ(waiting.blocked, 2u);
  ASSERT_EQ(wanted_.count(), 2u);
  EXPECT_EQ(wanted_.leaf(0), 0u);
  EXPECT_EQ(wanted_.leaf(1), 3u);
}

TEST_F(MostUrgentLeaves, TakeTurnsWhenTheyAreEquallyUrgent) {
  for (uint32_t i = 0; i < forest_->leaf_count; ++i) urgency(i) = Urgency::kWanted;
  urgencies_->split_at = 6;
  (void)find_most_urgent(*forest_, *urgencies_, kNobody, wanted_);
  for (uint32_t i = 0; i < Wanted::kLooks; ++i) EXPECT_EQ(wanted_.leaf(i), 6 * Urgency::kBlock + i);
}

TEST(SixteenTops, AreCountedAndFoundInOrder) {
  for (uint32_t bits = 0; bits < 1u << 16; ++bits) {
    std::array<uint32_t, 4> word{};
    uint32_t count = 0;
    for (uint32_t i = 0; i < 16; ++i) {
      word[i / 4] |= (bits >> i & 1u) << (8 * (i % 4) + 7);
      count += bits >> i & 1u;
    }
    const SixteenTops tops{word[0], word[1], word[2], word[3]};
    ASSERT_EQ(tops.bits(), bits);
    ASSERT_EQ(tops.count(), count);
    ASSERT_EQ(tops.any(), bits != 0);
    if (bits == 0) continue;
    ASSERT_EQ(bits & ((1u << SixteenTops::first(bits)) - 1u), 0u);
    ASSERT_EQ(SixteenTops::without_first(bits), bits ^ 1u << SixteenTops::first(bits));
  }
}

TEST(Urgencies, MoveWithTheirLeafIntoTheGap) {
  const auto urgencies = std::make_unique<Urgency>();
  urgencies->clear();
  urgencies->of[9] = Urgency::kMost;
  urgencies->move(4, 9);
  EXPECT_EQ(urgencies->of[4], Urgency::kMost);
  EXPECT_EQ(urgencies->of[9], Urgency::kNeutral);
  urgencies->move(4, 4);
  EXPECT_EQ(urgencies->of[4], Urgency::kNeutral);
}

/// However many are in the way: the search goes on where it ran out of looks.
TEST_F(MostUrgentLeaves, AreFoundBehindBlockedOnes) {
  ASSERT_EQ(refine_uniformly(*forest_, 6), MeshStatus::kDone);
  for (uint32_t i = 0; i < forest_->leaf_count; ++i) urgency(i) = Urgency::kMost;
  const uint16_t last = forest_->leaf_count - 1;
  const auto is_not_last = [&](const Leaf& leaf) { return &leaf == &forest_->leaf[last] ? 0u : 1u; };
  uint32_t ticks = 0;
  for (; wanted_.count() == 0 && ticks < 16; ++ticks) {
    const Waiting waiting = find_most_urgent(*forest_, *urgencies_, is_not_last, wanted_);
    EXPECT_EQ(waiting.all, forest_->leaf_count);
    EXPECT_LT(waiting.blocked, waiting.all);
  }
  ASSERT_EQ(wanted_.count(), 1u);
  EXPECT_EQ(wanted_.leaf(0), last);
  EXPECT_GT(ticks, 1u);
  EXPECT_LE(ticks, forest_->leaf_count / kMostLooks<Bar> + 1);
}

/// Each more urgent than all before it, which is as dear as it gets: the search ends, with the most urgent of
/// those that it took.
TEST_F(MostUrgentLeaves, AreFoundWithinTheBudgetOfOffers) {
  for (uint32_t i = 0; i < 120; ++i) urgency(i) = static_cast<uint8_t>(Urgency::kWanted + i);
  const Waiting waiting = find_most_urgent(*forest_, *urgencies_, kNobody, wanted_);
  EXPECT_EQ(waiting.all, 120u);
  EXPECT_EQ(wanted_.count(), Wanted::kLooks);
  EXPECT_EQ(wanted_.urgency(0), Urgency::kWanted + 8 * Wanted::kLooks - 1);
}

}  // namespace
}  // namespace palpate::test
