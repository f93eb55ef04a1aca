// Rotation fronts for tests, and random changes of a front and its mesh that keep the rules of both.
#pragma once

#include "palpate/mesh/front_invariants.hpp"
#include "support/forests.hpp"
#include "support/random.hpp"

namespace palpate::test {

template <class Profile>
struct MeshWithFront {
  Block block;
  std::unique_ptr<Forest<Profile>> forest;
  std::unique_ptr<RotationFront<Profile>> front;
};

/// `leaf_level` everywhere, groups at `group_level`.
template <class Profile>
MeshWithFront<Profile> mesh_with_front(const Block& block, uint8_t leaf_level, uint8_t group_level) {
  MeshWithFront<Profile> made{block, roots_of<Profile>(block), std::make_unique<RotationFront<Profile>>()};
  if (refine_uniformly(*made.forest, leaf_level) != MeshStatus::kDone ||
      !make_groups(*made.forest, *made.front, group_level)) {
    std::abort();
  }
  return made;
}

/// Splits this group and indexes again. The added group, or kNone.
template <class Profile>
uint16_t split_and_index(Forest<Profile>& forest, RotationFront<Profile>& front, uint16_t group) {
  if (forest.tet[front.tet[group]].is_leaf()) return kNone;
  auto steps = bounded_total<Profile::kLeaves>([] {});
  const uint16_t added = split_group(forest, front, group, steps);
  if (added != kNone) index_groups(forest, front);
  return added;
}

/// The group on the sibling tet, or kNone if the front is elsewhere there.
template <class Profile>
uint16_t sibling_group(const Forest<Profile>& forest, const RotationFront<Profile>& front, uint16_t group) {
  const uint16_t sibling = Forest<Profile>::sibling(front.tet[group]);
  if (forest.parent_of(sibling) == kNone) return kNone;
  const uint16_t other = forest.leaf_of(first_leaf(forest, sibling)).group;
  return front.tet[other] == sibling ? other : kNone;
}

/// Joins this group with its sibling and indexes again. False if it has none.
template <class Profile>
bool join_and_index(Forest<Profile>& forest, RotationFront<Profile>& front, uint16_t group) {
  const uint16_t gone = sibling_group(forest, front, group);
  if (gone == kNone) return false;
  auto steps = bounded_total<Profile::kLeaves>([] {});
  join_groups(forest, front, group, gone, steps);
  index_groups(forest, front);
  return true;
}

/// Bisects at this leaf tet or in its way, and indexes again.
template <class Profile>
bool bisect_and_index(Forest<Profile>& forest, RotationFront<Profile>& front, uint16_t wanted) {
  Patch patch{};
  if (find_ready_patch(forest, wanted, patch) != MeshStatus::kDone) return false;
  if (bisect(forest, patch) != MeshStatus::kDone) return false;
  count_and_index_groups(forest, front);
  return true;
}

/// Merges the patch that made this leaf tet, unless one of its children is a rotation tet.
template <class Profile>
bool merge_and_index(Forest<Profile>& forest, RotationFront<Profile>& front, uint16_t start) {
  Patch patch{};
  if (find_merge(forest, start, patch) != MeshStatus::kDone) return false;
  for (uint32_t i = 0; i < 2 * patch.count; ++i) {
    const Leaf& leaf = forest.leaf_of(forest.child(patch.tet[i / 2], i % 2));
    if (front.tet[leaf.group] == leaf.tet) return false;
  }
  merge(forest, patch);
  count_and_index_groups(forest, front);
  return true;
}

enum class Change : uint8_t { kBisect, kMerge, kSplit, kJoin };

/// One change at a random place, or none where it is not possible. Returns whether it was.
template <class Profile>
bool change_at_random(Forest<Profile>& forest, RotationFront<Profile>& front, Change change, Random& random) {
  const uint16_t tet = forest.leaf[random.below(forest.leaf_count)].tet;
  const uint16_t group = front.groups.live(random.below(front.groups.used()));
  switch (change) {
    case Change::kBisect:
      return bisect_and_index(forest, front, tet);
    case Change::kMerge:
      return merge_and_index(forest, front, tet);
    case Change::kSplit:
      return split_and_index(forest, front, group) != kNone;
    default:
      return join_and_index(forest, front, group);
  }
}

/// So many random changes of both.
template <class Profile>
void change_often(Forest<Profile>& forest, RotationFront<Profile>& front, uint32_t changes, Random& random) {
  for (uint32_t i = 0; i < changes; ++i) {
    (void)change_at_random(forest, front, static_cast<Change>(random.below(4)), random);
  }
}

}  // namespace palpate::test
