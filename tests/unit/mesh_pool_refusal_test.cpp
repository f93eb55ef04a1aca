// A full pool at every point where one is asked: the bisection is refused, counted, and has changed nothing.
#include <gtest/gtest.h>

#include "support/forests.hpp"
#include "support/random.hpp"

namespace palpate::test {
namespace {

/// Equal in every byte but the counters.
template <class Profile>
bool is_same_but_counters(const Forest<Profile>& a, const Forest<Profile>& b) {
  const auto same_bytes = [](const auto& one, const auto& other) {
    const void* a_bytes = one.data();
    const void* b_bytes = other.data();
    return std::memcmp(a_bytes, b_bytes, sizeof(one)) == 0;
  };
  const bool same_nodes = same_bytes(a.node.rest, b.node.rest) && a.node.mass == b.node.mass &&
                          same_bytes(a.node.position, b.node.position) &&
                          same_bytes(a.node.velocity, b.node.velocity) &&
                          same_bytes(a.node.force, b.node.force);
  const bool same_leaves = same_bytes(a.leaf, b.leaf);
  const bool same_tets = same_bytes(a.tet, b.tet);
  bool same_pools = a.nodes.used() == b.nodes.used() && a.pairs.used() == b.pairs.used();
  for (uint16_t i = 0; i < Profile::kNodes; ++i) {
    same_pools = same_pools && a.nodes.live(i) == b.nodes.live(i);
  }
  for (uint16_t i = 0; i < Forest<Profile>::kPairs; ++i) {
    same_pools = same_pools && a.pairs.parent(i) == b.pairs.parent(i) && a.pairs.level(i) == b.pairs.level(i);
  }
  return same_nodes && same_leaves && same_tets && same_pools && a.leaf_count == b.leaf_count;
}

template <class Profile>
Violation check_leaves(const Forest<Profile>& forest, const Block& block) {
  for (uint32_t i = 0; i < forest.leaf_count; ++i) {
    const Violation violation = check_leaf(forest, block, i);
    if (violation != Violation::kNothing) return violation;
  }
  return Violation::kNothing;
}

/// Bisects a cube patch by patch, anywhere, until it is refused; what that leaves must be untouched and
/// whole. `taken` nodes are taken from the pool beforehand.
template <class Profile>
MeshStatus fill(uint64_t seed, uint16_t taken, uint32_t& patches) {
  const Block block = full_block(1, 1, 1);
  Random random(seed);
  auto forest = roots_of<Profile>(block);
  for (uint16_t i = 0; i < taken; ++i) (void)forest->nodes.allocate();
  while (true) {
    Patch patch{};
    const uint16_t wanted = forest->leaf[random.below(forest->leaf_count)].tet;
    EXPECT_EQ(find_ready_patch(*forest, wanted, patch), MeshStatus::kDone);
    const auto before = copy_of(*forest);
    const MeshStatus status = bisect(*forest, patch);
    if (status == MeshStatus::kDone) {
      ++patches;
      continue;
    }
    EXPECT_TRUE(is_same_but_counters(*before, *forest));
    EXPECT_EQ(check_leaves(*forest, block), Violation::kNothing);
    const bool leaves = status == MeshStatus::kLeavesFull;
    EXPECT_EQ(forest->leaf_counters.refused, leaves ? 1 : 0);
    EXPECT_EQ(forest->nodes.counters().refused, leaves ? 0 : 1);
    EXPECT_EQ(forest->pairs.counters().refused, 0);
    EXPECT_EQ(forest->leaf_counters.peak, forest->leaf_count);
    EXPECT_EQ(forest->nodes.counters().peak, forest->nodes.used());
    return status;
  }
}

template <uint16_t Leaves>
void run_out_of_leaves() {
  uint32_t patches = 0;
  for (uint64_t seed = 0; seed < 50; ++seed) {
    EXPECT_EQ((fill<TestProfile<Leaves, 400, 14>>(seed, 0, patches)), MeshStatus::kLeavesFull);
  }
  EXPECT_EQ(patches > 0, Leaves >= 12);  // the first patch of a cube has all six roots
}

TEST(PoolRefusal, OfLeavesAtAnyPoint) {
  run_out_of_leaves<6>();
  run_out_of_leaves<11>();
  run_out_of_leaves<12>();
  run_out_of_leaves<31>();
  run_out_of_leaves<64>();
}

TEST(PoolRefusal, OfNodesAtEveryPoint) {
  using Profile = TestProfile<900, 100, 14>;
  for (uint16_t free = 0; free <= 92; ++free) {
    uint32_t patches = 0;
    const auto taken = static_cast<uint16_t>(92 - free);
    EXPECT_EQ(fill<Profile>(free, taken, patches), MeshStatus::kNodesFull);
    EXPECT_EQ(patches, free);
  }
}

/// Pairs cannot run out before leaves do, so leaves are named; here the test has taken the pairs away.
TEST(PoolRefusal, PairsAreCheckedBeforeAnythingChanges) {
  using Profile = TestProfile<200, 100, 9>;
  auto forest = roots_of<Profile>(full_block(1, 1, 1));
  Patch patch{};
  ASSERT_EQ(find_ready_patch(*forest, forest->leaf[0].tet, patch), MeshStatus::kDone);
  ASSERT_EQ(patch.count, 6u);
  while (forest->pairs.used() + patch.count - 1 < Forest<Profile>::kPairs)
    (void)forest->pairs.allocate(kNone, 0);
  const auto before = copy_of(*forest);
  EXPECT_EQ(bisect(*forest, patch), MeshStatus::kPairsFull);
  EXPECT_TRUE(is_same_but_counters(*before, *forest));
  EXPECT_EQ(forest->pairs.counters().refused, 1);
}

/// A block whose roots alone do not fit is refused with the pool that was too small.
TEST(PoolRefusal, RootsThatDoNotFit) {
  const Block block = bar_block();
  const auto status_of = [&](auto profile) {
    auto forest = std::make_unique<Forest<decltype(profile)>>();
    return make_roots(*forest, block, kOneDensity);
  };
  EXPECT_EQ(status_of(TestProfile<17, 16, 3>{}), MeshStatus::kLeavesFull);
  EXPECT_EQ(status_of(TestProfile<18, 15, 3>{}), MeshStatus::kNodesFull);
  EXPECT_EQ(status_of(TestProfile<18, 16, 3>{}), MeshStatus::kDone);
}

/// A merged node's slot is the next one that is used.
TEST(PoolRefusal, SlotsOfMergedNodesAreUsedAgain) {
  auto forest = roots_of<Bar>(bar_block());
  Patch patch{};
  ASSERT_EQ(find_ready_patch(*forest, forest->leaf[0].tet, patch), MeshStatus::kDone);
  ASSERT_EQ(bisect(*forest, patch), MeshStatus::kDone);
  const uint16_t middle = forest->nodes.live(forest->nodes.used() - 1u);
  EXPECT_TRUE(forest->nodes.is_live(middle));
  Patch back{};
  ASSERT_EQ(find_merge(*forest, forest->child(patch.tet[0], 0), back), MeshStatus::kDone);
  merge(*forest, back);
  EXPECT_FALSE(forest->nodes.is_live(middle));
  ASSERT_EQ(bisect(*forest, patch), MeshStatus::kDone);
  EXPECT_TRUE(forest->nodes.is_live(middle));
}

}  // namespace
}  // namespace palpate::test
