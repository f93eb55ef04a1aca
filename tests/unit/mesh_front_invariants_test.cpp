// Every kind of damage to a rotation front is found: each field is corrupted, and every FrontViolation
// occurs.
#include "palpate/mesh/front_invariants.hpp"

#include <gtest/gtest.h>

#include "support/fronts.hpp"
#include "support/pool_corruptor.hpp"

namespace palpate::test {
namespace {

using InvariantsProfile = TestProfile<600, 300, 9>;
using TestForest = Forest<InvariantsProfile>;
using TestFront = RotationFront<InvariantsProfile>;

/// Leaves and groups of several levels.
class FrontInvariants : public testing::Test {
 protected:
  FrontInvariants() : whole_(mesh_with_front<InvariantsProfile>(notched_block(), 1, 0)) {
    Random random(52);
    change_often(*whole_.forest, *whole_.front, 120, random);
  }

  /// What the checker says about a copy with this damage.
  template <class Damage>
  FrontViolation after(Damage damage) const {
    auto forest = copy_of(*whole_.forest);
    auto front = std::make_unique<TestFront>(*whole_.front);
    damage(*forest, *front);
    return check_front(*forest, *front);
  }

  /// A live group whose tet has children, or has none.
  [[nodiscard]] uint16_t any_group(bool is_leaf) const {
    for (uint32_t i = 0; i < whole_.front->groups.used(); ++i) {
      const uint16_t group = whole_.front->groups.live(i);
      if (whole_.forest->tet[whole_.front->tet[group]].is_leaf() == is_leaf) return group;
    }
    return kNone;
  }

  MeshWithFront<InvariantsProfile> whole_;
};

TEST_F(FrontInvariants, HoldBeforeAnyDamage) {
  EXPECT_EQ(after([](TestForest&, TestFront&) {}), FrontViolation::kNothing);
  EXPECT_NE(any_group(true), kNone);
  EXPECT_NE(any_group(false), kNone);
}

TEST_F(FrontInvariants, FindADamagedPool) {
  EXPECT_EQ(after([](TestForest&, TestFront& f) { PoolCorruptor::order(f.groups, 590) = 3; }),
            FrontViolation::kPool);
  EXPECT_EQ(after([](TestForest&, TestFront& f) { PoolCorruptor::place(f.groups, 2) = 1; }),
            FrontViolation::kPool);
  EXPECT_EQ(after([](TestForest&, TestFront& f) { PoolCorruptor::counters(f.groups).peak = 1; }),
            FrontViolation::kPool);
}

TEST_F(FrontInvariants, FindATetThatIsNotInUse) {
  const uint16_t group = any_group(false);
  EXPECT_EQ(after([=](TestForest&, TestFront& f) { f.tet[group] = kNone; }), FrontViolation::kTet);
  EXPECT_EQ(after([=](TestForest& m, TestFront& f) {
              uint32_t free = 0;
              while (m.pairs.is_live(free)) ++free;
              f.tet[group] = static_cast<uint16_t>(2u * free);
            }),
            FrontViolation::kTet);
}

TEST_F(FrontInvariants, FindAnotherTet) {
  const uint16_t group = any_group(false);
  EXPECT_NE(after([=](TestForest&, TestFront& f) { f.tet[group] ^= 1u; }), FrontViolation::kNothing);
  EXPECT_EQ(after([=](TestForest& m, TestFront& f) { f.tet[group] = m.child(f.tet[group], 1); }),
            FrontViolation::kCover);
  const uint16_t leaf_group = any_group(true);
  EXPECT_NE(after([=](TestForest&, TestFront& f) { f.tet[leaf_group] = f.tet[group]; }),
            FrontViolation::kNothing);
}

TEST_F(FrontInvariants, FindALeafInAnotherGroup) {
  const uint16_t other = whole_.front->groups.live(1);
  const uint16_t dead = whole_.front->groups.live(whole_.front->groups.used());
  for (const uint16_t wrong : {other, dead, kNone}) {
    for (uint32_t i = 0; i < whole_.forest->leaf_count; ++i) {
      if (whole_.forest->leaf[i].group == wrong) continue;
      ASSERT_EQ(after([=](TestForest& m, TestFront&) { m.leaf[i].group = wrong; }),
                FrontViolation::kLeafList);
      auto forest = copy_of(*whole_.forest);
      forest->leaf[i].group = wrong;
      ASSERT_EQ(check_leaf_group(*forest, *whole_.front, i), FrontViolation::kLeafGroup);
    }
  }
}

/// Two groups that agree with their lists but not with the tree.
TEST_F(FrontInvariants, FindLeavesUnderAnotherTet) {
  const uint16_t a = whole_.front->groups.live(0);
  for (uint32_t i = 1; i < whole_.front->groups.used(); ++i) {
    const uint16_t b = whole_.front->groups.live(i);
    const FrontViolation violation = after([=](TestForest&, TestFront& f) { std::swap(f.tet[a], f.tet[b]); });
    ASSERT_TRUE(violation == FrontViolation::kLeafGroup || violation == FrontViolation::kCover);
  }
}

TEST_F(FrontInvariants, FindAWrongPartner) {
  const uint16_t group = any_group(false);
  const uint16_t other = any_group(true);
  EXPECT_EQ(after([=](TestForest&, TestFront& f) { f.partner[group] = group; }), FrontViolation::kPartner);
  EXPECT_EQ(after([=](TestForest&, TestFront& f) { f.partner[group] = 599; }), FrontViolation::kPartner);
  EXPECT_EQ(after([=](TestForest&, TestFront& f) {
              f.partner[group] = other;
              f.partner[other] = group;
            }),
            FrontViolation::kPartner);
  const auto pair_up = [=](TestForest& m, TestFront& f, bool both) {
    const uint16_t added = split_and_index(m, f, group);
    f.partner[group] = added;
    if (both) f.partner[added] = group;
  };
  EXPECT_EQ(after([=](TestForest& m, TestFront& f) { pair_up(m, f, false); }), FrontViolation::kPartner);
  EXPECT_EQ(after([=](TestForest& m, TestFront& f) { pair_up(m, f, true); }), FrontViolation::kNothing);
}

TEST_F(FrontInvariants, FindAWrongLeafList) {
  for (uint32_t i = 0; i < whole_.forest->leaf_count; ++i) {
    for (const int wrong : {0, 1, 599, int{kNone}}) {
      if (whole_.front->leaf_order[i] == wrong) continue;
      ASSERT_EQ(after([=](TestForest&, TestFront& f) { f.leaf_order[i] = static_cast<uint16_t>(wrong); }),
                FrontViolation::kLeafList);
    }
  }
  const uint16_t group = any_group(false);
  EXPECT_EQ(after([=](TestForest&, TestFront& f) { f.leaves[group].count = 0; }), FrontViolation::kLeafList);
  EXPECT_EQ(after([=](TestForest&, TestFront& f) { f.leaves[group].count = kNone; }),
            FrontViolation::kLeafList);
  EXPECT_EQ(after([=](TestForest&, TestFront& f) { f.leaves[group].begin += 1; }), FrontViolation::kLeafList);
  EXPECT_EQ(after([=](TestForest&, TestFront& f) { f.leaves[group].count -= 1; }), FrontViolation::kCover);
}

TEST_F(FrontInvariants, FindAWrongNodeList) {
  uint32_t used = 0;
  for (uint32_t i = 0; i < whole_.front->groups.used(); ++i) {
    used += whole_.front->nodes[whole_.front->groups.live(i)].count;
  }
  for (uint32_t i = 0; i < used; ++i) {
    for (const int wrong : {0, 299, 300, int{kNone}}) {
      if (whole_.front->node_order[i] == wrong) continue;
      ASSERT_EQ(after([=](TestForest&, TestFront& f) { f.node_order[i] = static_cast<uint16_t>(wrong); }),
                FrontViolation::kNodeList);
    }
  }
  const uint16_t group = any_group(true);
  for (const int by : {-1, 1, 400, 60000}) {
    EXPECT_EQ(after([=](TestForest&, TestFront& f) {
                f.nodes[group].count = static_cast<uint16_t>(f.nodes[group].count + by);
              }),
              FrontViolation::kNodeList);
  }
}

TEST_F(FrontInvariants, FindListsThatLeaveAGap) {
  // The same leaves and nodes, elsewhere.
  EXPECT_EQ(after([](TestForest&, TestFront& f) {
              const uint16_t last = f.groups.live(f.groups.used() - 1u);
              const Span span = f.nodes[last];
              for (uint32_t i = 0; i < span.count; ++i) f.node_order[1000 + i] = f.node_order[span.begin + i];
              f.nodes[last].begin = 1000;
            }),
            FrontViolation::kSpans);
}

/// A front that was changed and not indexed again is objected to.
TEST_F(FrontInvariants, FindStaleLists) {
  const uint16_t group = any_group(false);
  EXPECT_NE(after([=](TestForest& m, TestFront& f) {
              auto steps = bounded_total<InvariantsProfile::kLeaves>([] {});
              (void)split_group(m, f, group, steps);
            }),
            FrontViolation::kNothing);
}

}  // namespace
}  // namespace palpate::test
