// Every kind of damage to a forest is found: each field of each structure is corrupted, and every Violation
// occurs.
#include "palpate/mesh/invariants.hpp"

#include <gtest/gtest.h>

#include "support/forests.hpp"
#include "support/pool_corruptor.hpp"
#include "support/random.hpp"

namespace palpate::test {
namespace {

using InvariantsProfile = TestProfile<600, 300, 9>;
using TestForest = Forest<InvariantsProfile>;

/// Adaptively refined, so that leaves of several levels meet.
class Invariants : public testing::Test {
 protected:
  Invariants() : block_(notched_block()), whole_(roots_of<InvariantsProfile>(block_)) {
    Random random(51);
    for (int i = 0; i < 25; ++i) {
      (void)bisect_with_closure(*whole_, whole_->leaf[random.below(whole_->leaf_count)].tet);
    }
  }

  /// What the checker says about a copy with this damage.
  template <class Damage>
  Violation after(Damage damage) const {
    auto copy = copy_of(*whole_);
    damage(*copy);
    return check_forest(*copy, block_);
  }

  /// What it says about one leaf; in a whole forest a neighbour may object first.
  template <class Damage>
  Violation of_leaf_after(uint32_t index, Damage damage) const {
    auto copy = copy_of(*whole_);
    damage(*copy);
    return check_leaf(*copy, block_, index);
  }

  /// An internal tet that is the parent of a leaf.
  [[nodiscard]] uint16_t any_parent() const {
    for (uint32_t i = 0; i < whole_->leaf_count; ++i) {
      const uint16_t parent = whole_->parent_of(whole_->leaf[i].tet);
      if (parent != kNone) return parent;
    }
    return kNone;
  }

  Block block_;
  std::unique_ptr<TestForest> whole_;
};

TEST_F(Invariants, HoldBeforeAnyDamage) {
  EXPECT_EQ(after([](TestForest&) {}), Violation::kNothing);
  EXPECT_GT(whole_->leaf_count, 100);
}

TEST_F(Invariants, FindADeadNode) {
  const auto free = static_cast<uint16_t>(whole_->nodes.live(whole_->nodes.used()));
  for (uint32_t i = 0; i < 4; ++i) {
    EXPECT_EQ(of_leaf_after(3, [=](TestForest& f) { f.leaf[3].node[i] = free; }), Violation::kDeadNode);
    EXPECT_EQ(of_leaf_after(3, [=](TestForest& f) { f.leaf[3].node[i] = kNone; }), Violation::kDeadNode);
  }
  EXPECT_EQ(after([](TestForest& f) { f.nodes.release(f.leaf[0].node[0]); }), Violation::kDeadNode);
}

TEST_F(Invariants, FindAWrongShape) {
  EXPECT_EQ(after([](TestForest& f) { f.node.rest[f.leaf[0].node[0]].x += 1; }), Violation::kWrongShape);
  EXPECT_EQ(after([](TestForest& f) { f.node.rest[f.leaf[0].node[1]].y -= 1; }), Violation::kWrongShape);
  EXPECT_EQ(after([](TestForest& f) { f.node.rest[f.leaf[0].node[2]].z += 2; }), Violation::kWrongShape);
  EXPECT_EQ(after([](TestForest& f) { std::swap(f.leaf[0].node[0], f.leaf[0].node[1]); }),
            Violation::kWrongShape);
  EXPECT_EQ(after([](TestForest& f) {
              const LeafKind kind = f.leaf[0].kind;
              f.leaf[0].kind = LeafKind(kind.path(), Axes::of(1, 0, 2), kind.region(), kind.level());
            }),
            Violation::kWrongShape);
}

TEST_F(Invariants, FindABrokenTree) {
  const uint16_t parent = any_parent();
  const uint16_t child = whole_->child(parent, 0);
  const Violation expected = Violation::kTreeLink;
  EXPECT_EQ(of_leaf_after(2, [](TestForest& f) { f.leaf[2].tet = kNone; }), expected);
  EXPECT_EQ(of_leaf_after(2, [](TestForest& f) { f.leaf[2].tet ^= 1u; }), expected);
  EXPECT_EQ(of_leaf_after(2,
                          [](TestForest& f) {
                            const LeafKind kind = f.leaf[2].kind;
                            f.leaf[2].kind =
                                LeafKind(kind.path(), kind.axes(), kind.region(), kind.level() + 3u);
                          }),
            expected);
  const uint16_t child_link = whole_->tet[child].link();
  const uint16_t parent_link = whole_->tet[parent].link();
  EXPECT_EQ(after([=](TestForest& f) { f.tet[child] = Tet::internal(child_link); }), expected);
  EXPECT_EQ(after([=](TestForest& f) { f.tet[child] = Tet::leaf(child_link + 1u); }), expected);
  EXPECT_EQ(after([=](TestForest& f) { f.tet[parent] = Tet::internal(parent_link + 1u); }), expected);
  EXPECT_EQ(after([=](TestForest& f) { f.tet[parent] = Tet::leaf(parent_link); }), expected);
  EXPECT_EQ(after([=](TestForest& f) { PoolCorruptor::parent(f.pairs, child >> 1) = kNone; }), expected);
  EXPECT_EQ(after([=](TestForest& f) { PoolCorruptor::parent(f.pairs, child >> 1) ^= 1u; }), expected);
  EXPECT_EQ(after([=](TestForest& f) { PoolCorruptor::level(f.pairs, child >> 1) += 3; }), expected);
  EXPECT_EQ(after([=](TestForest& f) { PoolCorruptor::level(f.pairs, parent >> 1) += 1; }), expected);
  EXPECT_EQ(after([=](TestForest& f) { f.pairs.release(static_cast<uint16_t>(child >> 1)); }), expected);
}

TEST_F(Invariants, FindAWrongNeighbour) {
  for (uint32_t i = 0; i < whole_->leaf_count; ++i) {
    for (uint32_t face = 0; face < 4; ++face) {
      const uint16_t own = whole_->leaf[i].tet;
      for (const uint16_t wrong : {own, static_cast<uint16_t>(own ^ 1u), any_parent(), whole_->leaf[7].tet,
                                   static_cast<uint16_t>(TestForest::kTets)}) {
        if (whole_->leaf[i].neighbour[face] == wrong) continue;
        ASSERT_EQ(after([=](TestForest& f) { f.leaf[i].neighbour[face] = wrong; }), Violation::kNeighbour);
      }
    }
  }
}

TEST_F(Invariants, FindAHole) {
  for (uint32_t i = 0; i < whole_->leaf_count; ++i) {
    for (uint32_t face = 0; face < 4; ++face) {
      if (whole_->leaf[i].neighbour[face] == kNone) continue;
      const Violation violation = after([=](TestForest& f) { f.leaf[i].neighbour[face] = kNone; });
      // The leaf on the other side may be checked first, and misses its neighbour.
      ASSERT_TRUE(violation == Violation::kHole || violation == Violation::kNeighbour);
      auto copy = copy_of(*whole_);
      copy->leaf[i].neighbour[face] = kNone;
      ASSERT_EQ(check_leaf(*copy, block_, i), Violation::kHole);
    }
  }
}

/// The checker must know the block: a surface that the block does not have is a hole.
TEST_F(Invariants, FindASurfaceInsideTheBlock) {
  Block other = block_;
  other.region[0] = 0;
  EXPECT_EQ(check_forest(*whole_, other), Violation::kHole);
}

TEST_F(Invariants, FindAMissingVolume) {
  // A tet of a cube that is not there any more: nothing that a leaf can see is wrong.
  Block less = block_;
  less.region[11] = Block::kAbsent;
  Block more = less;
  more.region[0] = 0;  // the same number of roots elsewhere
  EXPECT_NE(check_forest(*whole_, more), Violation::kNothing);
  auto copy = copy_of(*whole_);
  --copy->leaf_count;
  EXPECT_EQ(check_totals(*copy, block_), Violation::kLeafCount);
  const auto pair = static_cast<uint16_t>(any_parent() >> 1);
  copy->pairs.release(pair);
  EXPECT_EQ(check_totals(*copy, block_), Violation::kLeafCount) << "odd";
  --copy->leaf_count;
  for (uint32_t i = 0; i < copy->leaf_count; ++i) {
    const uint16_t parent = whole_->parent_of(whole_->leaf[i].tet);
    if (parent == kNone || parent >> 1 == pair) continue;
    copy->pairs.release(static_cast<uint16_t>(parent >> 1));
    break;
  }
  EXPECT_EQ(check_totals(*copy, block_), Violation::kVolume);
}

TEST_F(Invariants, FindAWrongMass) {
  for (uint32_t i = 0; i < whole_->nodes.used(); ++i) {
    const uint16_t node = whole_->nodes.live(i);
    ASSERT_EQ(after([=](TestForest& f) { f.node.mass[node] += 1; }), Violation::kMass);
  }
}

TEST_F(Invariants, FindAWrongCount) {
  EXPECT_EQ(after([](TestForest& f) { (void)f.pairs.allocate(kNone, 0); }), Violation::kLeafCount);
}

TEST_F(Invariants, FindAnUnusedNode) {
  EXPECT_EQ(after([](TestForest& f) { f.node.mass[f.nodes.allocate()] = 0; }), Violation::kNodeUse);
}

TEST_F(Invariants, FindADamagedPool) {
  EXPECT_EQ(after([](TestForest& f) { PoolCorruptor::order(f.nodes, 290) = 3; }), Violation::kPool);
  EXPECT_EQ(after([](TestForest& f) { PoolCorruptor::parent(f.pairs, 590) = kNone; }), Violation::kPool);
  EXPECT_EQ(after([](TestForest& f) { PoolCorruptor::counters(f.nodes).peak = 1; }), Violation::kPool);
}

}  // namespace
}  // namespace palpate::test
