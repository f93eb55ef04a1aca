// Random changes of the rotation front and of the mesh below it: the front stays a partition of the leaves
// with the lists that it promises, joining undoes splitting, and a patch of the front is what lies around its
// edge.
#include "palpate/mesh/front_patch.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>
#include <set>

#include "support/fronts.hpp"
#include "support/soak.hpp"

namespace palpate::test {
namespace {

/// A leaf's path is the way from its root.
template <class Profile>
void expect_paths(const Forest<Profile>& forest) {
  for (uint32_t i = 0; i < forest.leaf_count; ++i) {
    const Leaf& leaf = forest.leaf[i];
    uint16_t tet = leaf.tet;
    for (uint8_t level = leaf.level(); level > 0; --level) {
      ASSERT_EQ(child_towards(leaf, static_cast<uint8_t>(level - 1)), tet & 1u);
      tet = forest.parent_of(tet);
      ASSERT_EQ(ancestor_at(forest, leaf.tet, static_cast<uint8_t>(level - 1)), tet);
    }
    ASSERT_EQ(forest.parent_of(tet), kNone);
    ASSERT_EQ(leaf.path() >> leaf.level(), 0);
  }
}

template <class Profile>
void change_mesh_and_front(const Block& block, uint64_t seed, uint32_t changes) {
  Random random(seed);
  MeshWithFront<Profile> mesh = mesh_with_front<Profile>(block, 1, 0);
  std::array<uint32_t, 4> done{};
  uint32_t most_groups = 0;
  uint32_t most_pairs = 0;
  for (uint32_t i = 0; i < changes; ++i) {
    // Refining and coarsening of both fronts swing, each in its own time.
    const double finer = 0.5 + 0.45 * std::sin(i * 7e-3);
    const double deeper = 0.5 + 0.45 * std::sin(i * 3e-3);
    const bool of_mesh = random.below(2) == 0;
    const Change change = of_mesh ? (random.unit() < finer ? Change::kBisect : Change::kMerge)
                                  : (random.unit() < deeper ? Change::kSplit : Change::kJoin);
    done[static_cast<uint32_t>(change)] +=
        change_at_random(*mesh.forest, *mesh.front, change, random) ? 1u : 0u;
    const uint16_t last = mesh.front->groups.live(mesh.front->groups.used() - 1u);
    most_pairs =
        std::max(most_pairs, uint32_t{mesh.front->nodes[last].begin} + mesh.front->nodes[last].count);
    most_groups = std::max<uint32_t>(most_groups, mesh.front->groups.used());
    if (i % 16 != 0) continue;
    ASSERT_EQ(check_front(*mesh.forest, *mesh.front), FrontViolation::kNothing) << "change " << i;
    if (i % 256 == 0) {
      ASSERT_NO_FATAL_FAILURE(expect_paths(*mesh.forest));
    }
  }
  EXPECT_EQ(check_forest(*mesh.forest, block), Violation::kNothing);
  std::printf(
      "%u bisections, %u merges, %u splits, %u joins; at most %u groups, %u pairs of group and node\n",
      done[0], done[1], done[2], done[3], most_groups, most_pairs);
  for (const uint32_t count : done) EXPECT_GT(count, changes / 50);
}

uint32_t changes() { return in_soak(1000000u, 12000u); }

TEST(RotationFront, StaysAPartitionOfTheBar) {
  change_mesh_and_front<TestProfile<400, 200, 9>>(bar_block(), 61, changes());
}
TEST(RotationFront, StaysAPartitionOfANotchedBlock) {
  change_mesh_and_front<TestProfile<500, 300, 6>>(notched_block(), 62, changes());
}
TEST(RotationFront, StaysAPartitionOfADeepCube) {
  change_mesh_and_front<TestProfile<300, 150, 14>>(full_block(1, 1, 1), 63, changes());
}

struct ThirtyGroups : TestProfile<400, 200, 9> {
  static constexpr uint16_t kGroups = 30;
};
TEST(RotationFront, SurvivesGroupsThatRunOut) {
  change_mesh_and_front<ThirtyGroups>(bar_block(), 64, changes());
}

/// The same by rapidcheck, which shrinks a sequence that fails to the few changes that matter.
RC_GTEST_PROP(RotationFront, AnyShortSequenceKeepsIt, (const std::vector<uint16_t>& changes)) {
  using Profile = TestProfile<200, 120, 9>;
  MeshWithFront<Profile> mesh = mesh_with_front<Profile>(full_block(1, 1, 1), 0, 0);
  for (const uint16_t change : changes) {
    Random random(change);
    (void)change_at_random(*mesh.forest, *mesh.front, static_cast<Change>(change % 4), random);
    RC_ASSERT(check_front(*mesh.forest, *mesh.front) == FrontViolation::kNothing);
  }
}

using FrontProfile = TestProfile<400, 200, 9>;

/// A front without the numbers of its groups: the leaves of each tet on it, in order.
std::map<uint16_t, std::vector<uint16_t>> content(const RotationFront<FrontProfile>& front) {
  std::map<uint16_t, std::vector<uint16_t>> leaves;
  for (uint32_t i = 0; i < front.groups.used(); ++i) {
    const uint16_t group = front.groups.live(i);
    const auto begin = front.leaf_order.begin() + front.leaves[group].begin;
    leaves[front.tet[group]] = std::vector<uint16_t>(begin, begin + front.leaves[group].count);
  }
  return leaves;
}

TEST(RotationFront, JoiningUndoesSplitting) {
  Random random(65);
  MeshWithFront<FrontProfile> mesh = mesh_with_front<FrontProfile>(bar_block(), 2, 0);
  uint32_t splits = 0;
  for (int round = 0; round < 200; ++round) {
    change_often(*mesh.forest, *mesh.front, 5, random);
    const auto before = content(*mesh.front);
    const uint16_t group = mesh.front->groups.live(random.below(mesh.front->groups.used()));
    const uint16_t tet = mesh.front->tet[group];
    const uint16_t added = split_and_index(*mesh.forest, *mesh.front, group);
    if (added == kNone) continue;
    ++splits;
    EXPECT_EQ(mesh.front->tet[group], mesh.forest->child(tet, 0));
    EXPECT_EQ(mesh.front->tet[added], mesh.forest->child(tet, 1));
    EXPECT_FALSE(is_second_of_pair(*mesh.front, group));
    EXPECT_TRUE(is_second_of_pair(*mesh.front, added));
    ASSERT_TRUE(join_and_index(*mesh.forest, *mesh.front, group));
    ASSERT_EQ(content(*mesh.front), before);
  }
  EXPECT_GT(splits, 50u);
}

/// Before the lists are made again: no memory of who had its place before.
TEST(RotationFront, ANewGroupKnowsHowManyLeavesItHas) {
  MeshWithFront<FrontProfile> mesh = mesh_with_front<FrontProfile>(bar_block(), 3, 1);
  ASSERT_TRUE(join_and_index(*mesh.forest, *mesh.front, 0));
  auto steps = bounded_total<FrontProfile::kLeaves>([] {});
  const uint16_t added = split_group(*mesh.forest, *mesh.front, 2, steps);
  ASSERT_NE(added, kNone);
  const auto leaves_of = [&](uint16_t group) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < mesh.forest->leaf_count; ++i)
      count += mesh.forest->leaf[i].group == group ? 1u : 0u;
    return count;
  };
  EXPECT_EQ(mesh.front->leaves[added].count, leaves_of(added));
  EXPECT_EQ(mesh.front->leaves[2].count, leaves_of(2));
}

TEST(RotationFront, IsMadeOfTheTetsAtALevelAndOfLeavesAboveIt) {
  Random random(66);
  MeshWithFront<FrontProfile> mesh = mesh_with_front<FrontProfile>(bar_block(), 2, 0);
  change_often(*mesh.forest, *mesh.front, 60, random);
  for (uint8_t level = 0; level <= 9; ++level) {
    ASSERT_TRUE(make_groups(*mesh.forest, *mesh.front, level));
    ASSERT_EQ(check_front(*mesh.forest, *mesh.front), FrontViolation::kNothing);
    for (uint32_t i = 0; i < mesh.front->groups.used(); ++i) {
      const uint16_t tet = mesh.front->tet[mesh.front->groups.live(i)];
      const uint8_t own = mesh.forest->level_of(tet);
      ASSERT_TRUE(own == level || (own < level && mesh.forest->tet[tet].is_leaf()));
    }
  }
  EXPECT_EQ(mesh.front->groups.used(), mesh.forest->leaf_count);
}

TEST(RotationFront, RefusesASplitWithoutAFreeGroupAndChangesNothing) {
  MeshWithFront<ThirtyGroups> mesh = mesh_with_front<ThirtyGroups>(bar_block(), 3, 0);
  for (uint16_t group = 0; mesh.front->groups.used() < ThirtyGroups::kGroups; ++group) {
    ASSERT_NE(split_and_index(*mesh.forest, *mesh.front, group), kNone);
  }
  const auto before = *mesh.front;
  EXPECT_EQ(split_and_index(*mesh.forest, *mesh.front, 17), kNone);
  EXPECT_EQ(mesh.front->groups.counters().refused, 1);
  EXPECT_EQ(mesh.front->tet, before.tet);
  EXPECT_EQ(mesh.front->groups.used(), before.groups.used());
  EXPECT_EQ(check_front(*mesh.forest, *mesh.front), FrontViolation::kNothing);
}

/// All tets at a level by the ends of their refinement edges, from the roots down by the rule of bisection.
class EdgeMap {
 public:
  EdgeMap(const Forest<FrontProfile>& forest, const Forest<FrontProfile>& roots) : forest_(forest) {
    for (uint32_t i = 0; i < roots.leaf_count; ++i)
      visit(roots.leaf[i].tet, corners_of(roots, roots.leaf[i]), 0);
  }
  [[nodiscard]] const std::set<uint16_t>& around_edge_of(uint16_t tet) const {
    return around_.at(edge_.at(tet));
  }

 private:
  using Edge = std::tuple<uint8_t, Point, Point>;

  void visit(uint16_t tet, const Corners& w, uint8_t level) {
    const uint32_t end = refinement_end(type_of_level(level));
    const Edge edge{level, std::min(w[0], w[end]), std::max(w[0], w[end])};
    edge_[tet] = edge;
    around_[edge].insert(tet);
    if (forest_.tet[tet].is_leaf()) return;
    const auto [x0, y0, z0] = w[0];
    const auto [x1, y1, z1] = w[end];
    const Point middle((x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2);
    Corners first = w;
    first[end] = middle;
    Corners second = w;
    for (uint32_t i = 0; i < end; ++i) second[i] = w[i + 1];
    second[end] = middle;
    visit(forest_.child(tet, 0), first, static_cast<uint8_t>(level + 1));
    visit(forest_.child(tet, 1), second, static_cast<uint8_t>(level + 1));
  }

  const Forest<FrontProfile>& forest_;
  std::map<uint16_t, Edge> edge_;
  std::map<Edge, std::set<uint16_t>> around_;
};

/// Where the front is coarser, the tets below it are left out and one of the coarser groups is named.
TEST(FrontPatch, IsAllTetsAroundTheEdgeOrNamesACoarserGroup) {
  Random random(67);
  uint32_t ready = 0;
  uint32_t blocked = 0;
  for (int round = 0; round < 60; ++round) {
    const Block block = round % 2 == 0 ? bar_block() : full_block(2, 2, 1);
    MeshWithFront<FrontProfile> mesh = mesh_with_front<FrontProfile>(block, 2, 0);
    change_often(*mesh.forest, *mesh.front, 100, random);
    const EdgeMap edges(*mesh.forest, *roots_of<FrontProfile>(block));
    for (uint16_t tet = 0; tet < Forest<FrontProfile>::kTets; ++tet) {
      if (!mesh.forest->pairs.is_live(tet >> 1) || mesh.forest->tet[tet].is_leaf()) continue;
      std::set<uint16_t> expected;
      std::set<uint16_t> coarser;
      for (const uint16_t other : edges.around_edge_of(tet)) {
        const uint16_t group = mesh.forest->leaf_of(first_leaf(*mesh.forest, other)).group;
        const uint8_t level = mesh.forest->level_of(mesh.front->tet[group]);
        (level < mesh.forest->level_of(tet) ? coarser : expected)
            .insert(level < mesh.forest->level_of(tet) ? group : other);
      }
      FrontPatch patch{};
      const MeshStatus status = find_front_patch(*mesh.forest, *mesh.front, tet, patch);
      const bool is_ready = coarser.empty();
      ++(is_ready ? ready : blocked);
      ASSERT_EQ(status, is_ready ? MeshStatus::kDone : MeshStatus::kNotReady);
      ASSERT_EQ(coarser.count(patch.blocker), is_ready ? 0u : 1u);
      ASSERT_EQ(patch.blocker == kNone, is_ready);
      ASSERT_EQ(std::set<uint16_t>(patch.tet.begin(), patch.tet.begin() + patch.count), expected);
      ASSERT_EQ(patch.count, expected.size());
    }
  }
  std::printf("%u patches ready, %u blocked\n", ready, blocked);
  EXPECT_GT(ready, 500u);
  EXPECT_GT(blocked, 500u);
}

}  // namespace
}  // namespace palpate::test
