// The rotation front: the tets whose rotation is extracted, each a leaf or an ancestor of leaves. Such a tet
// with its leaves is a group; every leaf belongs to exactly one. Splitting a group puts its tet's two
// children on the front, joining is the inverse; neither changes the mesh.
//
// Leaves and nodes of a group lie side by side in leaf_order and node_order, which index_groups rebuilds
// after changes of the front or of the mesh. A group of n leaves has at most n + 3 nodes, so all lists are
// bounded.
#pragma once

#include "palpate/mesh/forest.hpp"

namespace palpate {

/// A part of leaf_order or node_order. A whole word, so that a copy needs no call.
struct alignas(uint32_t) Span {
  uint16_t begin;
  uint16_t count;
};

template <class Profile>
struct RotationFront {
  static constexpr uint16_t kGroups = Profile::kGroups;
  /// Pairs of a group and a node of it.
  static constexpr uint32_t kGroupNodes = static_cast<uint32_t>(Profile::kLeaves) + 3u * kGroups;
  static_assert(kGroupNodes < 0xffff, "palpate: a span counts in 16 bits");
  /// Nodes of one group, which is a root or part of one.
  static constexpr uint32_t kNodesOfRoot = most_nodes_of_root(Profile::kMaxLevel);
  static constexpr uint32_t kNodesOfGroup = kNodesOfRoot < Profile::kNodes ? kNodesOfRoot : Profile::kNodes;

  IndexPool<kGroups> groups;
  std::array<uint16_t, kGroups> tet;      // on the front
  std::array<uint16_t, kGroups> partner;  // the sibling's group that it is about to be joined with, or kNone
  std::array<Span, kGroups> leaves;
  std::array<Span, kGroups> nodes;
  std::array<uint16_t, Profile::kLeaves> leaf_order;  // places in Forest::leaf
  std::array<uint16_t, kGroupNodes + 1> node_order;   // the last one is scratch of index_nodes
  // Of each node, scratch: the group that named it last, while node_order is made; its place in the list of
  // the group whose forces are computed.
  std::array<uint32_t, Profile::kNodes> mark;
  uint16_t pairs_at;  // of groups, the place where the looks at pairs go on
};

/// Whether a group's tet is the second child of its parent.
template <class Profile>
[[nodiscard]] bool is_second_of_pair(const RotationFront<Profile>& front, uint16_t group) {
  return (front.tet[group] & 1u) != 0;
}

/// The tet at `level` that holds `tet`, which is at this level or deeper. O(levels).
template <class Profile>
[[nodiscard]] uint16_t ancestor_at(const Forest<Profile>& forest, uint16_t tet, uint8_t level) {
  for ([[maybe_unused]] const uint32_t step : bounded<Profile::kMaxLevel>(Profile::kMaxLevel, [] {})) {
    if (forest.level_of(tet) <= level) break;
    tet = forest.parent_of(tet);
  }
  return tet;
}

/// The leaf at the end of all first children of `tet`. It has the tet's first vertex. O(levels).
template <class Profile>
[[nodiscard]] uint16_t first_leaf(const Forest<Profile>& forest, uint16_t tet) {
  for ([[maybe_unused]] const uint32_t step : bounded<Profile::kMaxLevel>(Profile::kMaxLevel, [] {})) {
    if (forest.tet[tet].is_leaf()) break;
    tet = forest.child(tet, 0);
  }
  return tet;
}

/// The first half of index_groups: the leaves of each group, in their order.
template <class Profile>
PALPATE_NOINLINE void index_leaves(const Forest<Profile>& forest, RotationFront<Profile>& front) {
  std::array<uint32_t, Profile::kGroups> at;  // of each group: how many leaves, then where its next one goes
  for (const uint32_t i : bounded<Profile::kGroups>(front.groups.used(), [] {})) at[front.groups.live(i)] = 0;
#pragma GCC unroll 4
  for (const uint32_t i : bounded<Profile::kLeaves>(forest.leaf_count, [] {})) ++at[forest.leaf[i].group];
  uint32_t begin = 0;
  for (const uint32_t i : bounded<Profile::kGroups>(front.groups.used(), [] {})) {
    const uint16_t group = front.groups.live(i);
    const uint32_t count = at[group];
    front.leaves[group] = Span{static_cast<uint16_t>(begin), static_cast<uint16_t>(count)};
    at[group] = begin;
    begin += count;
  }
#pragma GCC unroll 4
  for (const uint32_t i : bounded<Profile::kLeaves>(forest.leaf_count, [] {})) {
    uint32_t& next = at[forest.leaf[i].group];
    front.leaf_order[next] = static_cast<uint16_t>(i);
    ++next;
  }
}

/// The second half: the nodes of each group, in the order in which its leaves name them.
template <class Profile>
PALPATE_NOINLINE void index_nodes(const Forest<Profile>& forest, RotationFront<Profile>& front) {
  uint32_t* const last_group = front.mark.data();
#pragma GCC unroll 8
  for (const uint32_t i : bounded<Profile::kNodes>(Profile::kNodes, [] {})) last_group[i] = kNone;
  auto leaves = bounded_total<Profile::kLeaves>([] {});
  uint16_t* end = front.node_order.data();
  for (const uint32_t i : bounded<Profile::kGroups>(front.groups.used(), [] {})) {
    const uint32_t group = front.groups.live(i);
    const uint16_t* const begin = end;
    const Span span = front.leaves[group];
    for (const uint32_t at : leaves.take(span.begin, span.count)) {
      // All is loaded before anything is stored.
      const std::array<uint16_t, 4>& node = forest.leaf[front.leaf_order[at]].node;
      const uint16_t node0 = node[0], node1 = node[1], node2 = node[2], node3 = node[3];
      // 1 for one that is new in this group, without a branch.
      const auto is_new = [&](uint16_t which) { return ((last_group[which] ^ group) + 0xffffu) >> 16; };
      const uint32_t added0 = is_new(node0), added1 = is_new(node1), added2 = is_new(node2),
                     added3 = is_new(node3);
      // Written in any case, and overwritten unless it is new.
      const auto add = [&](uint16_t which, uint32_t added) {
        *end = which;
        end += added;
        last_group[which] = group;
      };
      add(node0, added0);
      add(node1, added1);
      add(node2, added2);
      add(node3, added3);
    }
    front.nodes[group] =
        Span{static_cast<uint16_t>(begin - front.node_order.data()), static_cast<uint16_t>(end - begin)};
  }
}

/// Rebuilds the lists of all groups from Leaf::group. O(leaves + nodes + groups).
template <class Profile>
void index_groups(const Forest<Profile>& forest, RotationFront<Profile>& front) {
  index_leaves(forest, front);
  index_nodes(forest, front);
}

/// One group for each tet at `level`, or for a leaf above it. False when there are more of them than groups.
/// O(leaves x levels), at boot.
template <class Profile>
[[nodiscard]] bool make_groups(Forest<Profile>& forest, RotationFront<Profile>& front, uint8_t level) {
  front.groups.clear();
  front.pairs_at = 0;
  for (const uint32_t i : bounded<Profile::kLeaves>(forest.leaf_count, [] {})) {
    const uint16_t tet = ancestor_at(forest, forest.leaf[i].tet, level);
    if (first_leaf(forest, tet) != forest.leaf[i].tet) continue;
    const uint16_t group = front.groups.allocate();
    if (group == kNone) return false;
    front.tet[group] = tet;
    front.partner[group] = kNone;
    forest.leaf[i].group = group;
  }
  for (const uint32_t i : bounded<Profile::kLeaves>(forest.leaf_count, [] {})) {
    const uint16_t tet = ancestor_at(forest, forest.leaf[i].tet, level);
    forest.leaf[i].group = forest.leaf_of(first_leaf(forest, tet)).group;
  }
  index_groups(forest, front);
  return true;
}

/// Puts the children of a group's tet, which must not be a leaf, on the front in its place: the group keeps
/// child 0, a new one, which is returned, takes child 1. kNone, and nothing changed, when all groups are in
/// use. `leaves` is a BoundedTotal that has the group's leaves left. Until index_groups the lists of `group`
/// are the old ones and those of the new one are empty.
template <class Profile, class Total>
[[nodiscard]] uint16_t split_group(Forest<Profile>& forest, RotationFront<Profile>& front, uint16_t group,
                                   Total& leaves) {
  const uint16_t added = front.groups.allocate();
  if (added == kNone) return kNone;
  const uint16_t tet = front.tet[group];
  front.tet[group] = forest.child(tet, 0);
  front.tet[added] = forest.child(tet, 1);
  front.partner[added] = kNone;
  front.leaves[added] = Span{0, 0};
  front.nodes[added] = Span{0, 0};
  const uint8_t level = forest.level_of(tet);
  const Span span = front.leaves[group];
#pragma GCC unroll 4
  for (const uint32_t at : leaves.take(span.begin, span.count)) {
    Leaf& leaf = forest.leaf[front.leaf_order[at]];
    leaf.group = child_towards(leaf, level) == 1 ? added : group;
  }
  return added;
}

/// The inverse: `group` and `gone`, whose tets are siblings, become one on their parent, which keeps `group`.
template <class Profile, class Total>
void join_groups(Forest<Profile>& forest, RotationFront<Profile>& front, uint16_t group, uint16_t gone,
                 Total& leaves) {
  const Span span = front.leaves[gone];
  for (const uint32_t at : leaves.take(span.begin, span.count)) {
    forest.leaf[front.leaf_order[at]].group = group;
  }
  front.tet[group] = forest.parent_of(front.tet[group]);
  front.partner[group] = kNone;
  front.groups.release(gone);
}

}  // namespace palpate
