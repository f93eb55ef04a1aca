// Random bisections and merges, one patch at a time, on blocks of all kinds: after every operation the leaves
// that it touched and their neighbours hold all invariants, and every 1000 operations the whole forest does.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <set>

#include "support/forests.hpp"
#include "support/random.hpp"
#include "support/soak.hpp"

namespace palpate::test {
namespace {

constexpr std::array<uint16_t, kRegions> kTwoDensities = {2048, 1111, 2048, 2048, 2048, 2048, 2048, 2048};

template <class Profile>
class Walk {
 public:
  Walk(const Block& block, uint64_t seed) : block_(block), random_(seed) {
    forest_ = roots_of<Profile>(block, kTwoDensities);
  }

  /// Until so many patches were bisected or merged.
  void run(uint32_t operations) {
    const uint32_t roots = forest_->leaf_count;
    for (uint32_t i = 1; bisections + merges < operations && !testing::Test::HasFatalFailure(); ++i) {
      // The share of bisections swings, so that full and empty forests are both visited.
      const double share = 0.5 + 0.45 * std::sin(i * 2e-3);
      const auto start = forest_->leaf[random_.below(forest_->leaf_count)].tet;
      random_.unit() < share ? bisect_at(start) : merge_at(start);
      if (i % 1000 == 0) {
        ASSERT_EQ(check_forest(*forest_, block_), Violation::kNothing) << "operation " << i;
      }
    }
    merge_all(*forest_);
    ASSERT_EQ(forest_->leaf_count, roots);
    ASSERT_EQ(check_forest(*forest_, block_), Violation::kNothing);
    ASSERT_TRUE(content_of(*forest_) == content_of(*roots_of<Profile>(block_, kTwoDensities)));
  }

  uint32_t bisections = 0, merges = 0, refusals = 0, largest_patch = 0;
  uint16_t most_leaves = 0;

 private:
  void bisect_at(uint16_t wanted) {
    Patch patch{};
    const MeshStatus found = find_ready_patch(*forest_, wanted, patch);
    if (found == MeshStatus::kLevelLimit) return;
    ASSERT_EQ(found, MeshStatus::kDone);
    ASSERT_LE(patch.count, kMaxPatch);
    largest_patch = std::max(largest_patch, patch.count);
    const MeshStatus done = bisect(*forest_, patch);
    if (done != MeshStatus::kDone) {
      ++refusals;
      return;
    }
    ++bisections;
    most_leaves = std::max(most_leaves, forest_->leaf_count);
    std::set<uint16_t> tets;
    for (uint32_t i = 0; i < patch.count; ++i) {
      tets.insert(forest_->child(patch.tet[i], 0));
      tets.insert(forest_->child(patch.tet[i], 1));
    }
    check_around(tets);
  }

  void merge_at(uint16_t start) {
    Patch patch{};
    if (find_merge(*forest_, start, patch) != MeshStatus::kDone) return;
    ASSERT_LE(patch.count, kMaxPatch);
    merge(*forest_, patch);
    ++merges;
    check_around(std::set<uint16_t>(patch.tet.begin(), patch.tet.begin() + patch.count));
  }

  void check_around(const std::set<uint16_t>& tets) {
    std::set<uint32_t> touched;
    for (const uint16_t tet : tets) {
      touched.insert(forest_->tet[tet].link());
      for (const uint16_t beyond : forest_->leaf_of(tet).neighbour) {
        if (beyond != kNone) touched.insert(forest_->tet[beyond].link());
      }
    }
    for (const uint32_t index : touched) {
      ASSERT_EQ(check_leaf(*forest_, block_, index), Violation::kNothing) << "leaf " << index;
    }
  }

  Block block_;
  Random random_;
  std::unique_ptr<Forest<Profile>> forest_;
};

template <class Profile>
void walk(const Block& block, uint64_t seed, uint32_t operations) {
  Walk<Profile> walk(block, seed);
  walk.run(operations);
  std::printf("%u bisections, %u merges, %u refused, at most %u leaves, %u tets in a patch\n",
              walk.bisections, walk.merges, walk.refusals, static_cast<unsigned>(walk.most_leaves),
              walk.largest_patch);
  EXPECT_GT(walk.bisections, operations / 3);
  EXPECT_GT(walk.merges, operations / 3);
}

uint32_t operations() { return in_soak(1000000u, 100000u); }

TEST(MeshChanges, KeepTheBarWhole) { walk<Bar>(bar_block(), 1, operations()); }
TEST(MeshChanges, KeepANotchedBlockWhole) {
  walk<TestProfile<4000, 1500, 9>>(notched_block(), 2, operations() / 2);
}
TEST(MeshChanges, KeepADeepCubeWhole) {
  walk<TestProfile<3000, 1200, 14>>(full_block(1, 1, 1), 3, operations() / 2);
}
TEST(MeshChanges, SurviveAForestThatIsOftenFull) {
  walk<TestProfile<150, 64, 14>>(full_block(2, 1, 1), 4, operations() / 4);
}
TEST(MeshChanges, SurviveNodesThatRunOutFirst) {
  walk<TestProfile<1000, 60, 9>>(full_block(1, 2, 1), 5, operations() / 4);
}

/// The same by rapidcheck, which shrinks a sequence that fails to the few operations that matter.
RC_GTEST_PROP(MeshChanges, AnyShortSequenceKeepsACubeWhole, (const std::vector<uint16_t>& operations)) {
  using Profile = TestProfile<400, 200, 9>;
  auto forest = roots_of<Profile>(full_block(1, 1, 1));
  for (const uint16_t operation : operations) {
    const uint16_t start = forest->leaf[operation / 2u % forest->leaf_count].tet;
    Patch patch{};
    if (operation % 2 == 0 && find_ready_patch(*forest, start, patch) == MeshStatus::kDone) {
      RC_ASSERT(bisect(*forest, patch) == MeshStatus::kDone || forest->leaf_counters.refused > 0);
    } else if (operation % 2 == 1 && find_merge(*forest, start, patch) == MeshStatus::kDone) {
      merge(*forest, patch);
    }
    RC_ASSERT(check_forest(*forest, full_block(1, 1, 1)) == Violation::kNothing);
  }
}

/// Bisects a patch anywhere in a random mesh and merges it again: nothing remains of it, to the last mass
/// unit.
TEST(MeshChanges, MergeIsTheInverseOfBisect) {
  Random random(6);
  auto forest = roots_of<Deep>(notched_block(), kTwoDensities);
  for (uint32_t round = 0; round < 300; ++round) {
    Patch patch{};
    const uint16_t wanted = forest->leaf[random.below(forest->leaf_count)].tet;
    ASSERT_EQ(find_ready_patch(*forest, wanted, patch), MeshStatus::kDone);
    const Content before = content_of(*forest);
    const uint16_t parent = patch.tet[random.below(patch.count)];
    ASSERT_EQ(bisect(*forest, patch), MeshStatus::kDone);
    ASSERT_FALSE(content_of(*forest) == before);
    Patch back{};
    ASSERT_EQ(find_merge(*forest, forest->child(parent, random.below(2)), back), MeshStatus::kDone);
    ASSERT_EQ(std::set<uint16_t>(back.tet.begin(), back.tet.begin() + back.count),
              std::set<uint16_t>(patch.tet.begin(), patch.tet.begin() + patch.count));
    merge(*forest, back);
    ASSERT_TRUE(content_of(*forest) == before) << "round " << round;
    ASSERT_EQ(check_forest(*forest, notched_block()), Violation::kNothing);
    ASSERT_NE(bisect_with_closure(*forest, wanted), 0u);
  }
}

/// A new node starts at the mean position and velocity of its edge's ends, rounded once.
TEST(MeshChanges, ANewNodeIsTheMeanOfItsEdge) {
  Random random(7);
  auto forest = roots_of<Bar>(bar_block());
  for (uint32_t i = 0; i < forest->nodes.used(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      forest->node.position[i][axis] = Position::from_raw(static_cast<int32_t>(random.centred() * 5e8));
      forest->node.velocity[i][axis] = Velocity::from_raw(static_cast<int32_t>(random.centred() * 2e9));
    }
  }
  for (uint32_t round = 0; round < 100; ++round) {
    Patch patch{};
    ASSERT_EQ(find_ready_patch(*forest, forest->leaf[random.below(forest->leaf_count)].tet, patch),
              MeshStatus::kDone);
    const Leaf leaf = forest->leaf_of(patch.tet[0]);
    const uint32_t end = refinement_end(type_of_level(leaf.level()));
    ASSERT_EQ(bisect(*forest, patch), MeshStatus::kDone);
    const uint16_t middle = forest->leaf_of(forest->child(patch.tet[0], 0)).node[end];
    for (int axis = 0; axis < 3; ++axis) {
      const auto mean = [&](const auto& of) {
        return (int64_t{of[leaf.node[0]][axis].raw()} + of[leaf.node[end]][axis].raw() + 1) >> 1;
      };
      ASSERT_EQ(forest->node.position[middle][axis].raw(), mean(forest->node.position));
      ASSERT_EQ(forest->node.velocity[middle][axis].raw(), mean(forest->node.velocity));
    }
  }
}

}  // namespace
}  // namespace palpate::test
