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

/// The second half of index_groups: the nodes of each group, in the order in which its leaves name them.
template <class Profile>
void index_nodes(const Forest<Profile>& forest, RotationFront<Profile>& front) {
  for (const uint32_t i : bounded<Profile::kNodes>(forest.nodes.used(), [] {})) {
    front.mark[forest.nodes.live(i)] = kNone;
  }
  auto leaves = bounded_total<Profile::kLeaves>([] {});
  uint16_t end = 0;
  for (const uint32_t i : bounded<Profile::kGroups>(front.groups.used(), [] {})) {
    const uint16_t group = front.groups.live(i);
    const uint16_t begin = end;
    const Span span = front.leaves[group];
    for (const uint32_t at : leaves.take(span.begin, span.count)) {
      const std::array<uint16_t, 4>& node = forest.leaf[front.leaf_order[at]].node;
      // 1 for one that is new in this group, without a branch; all before anything is stored.
      const auto is_new = [&](uint32_t j) { return ((front.mark[node[j]] ^ group) + 0xffffu) >> 16; };
      const std::array<uint32_t, 4> added = {is_new(0), is_new(1), is_new(2), is_new(3)};
      // Written in any case, and overwritten unless it is new.
      const auto add = [&](uint32_t j) {
        front.node_order[end] = node[j];
        end = static_cast<uint16_t>(end + added[j]);
        front.mark[node[j]] = group;
      };
      add(0);
      add(1);
      add(2);
      add(3);
    }
    front.nodes[group] = Span{begin, static_cast<uint16_t>(end - begin)};
  }
}

/// Rebuilds the lists of all groups from Leaf::group. O(leaves + nodes + groups).
template <class Profile>
void index_groups(const Forest<Profile>& forest, RotationFront<Profile>& front) {
  for (const uint32_t i : bounded<Profile::kGroups>(front.groups.used(), [] {})) {
    front.leaves[front.groups.live(i)] = Span{0, 0};
  }
  for (const uint32_t i : bounded<Profile::kLeaves>(forest.leaf_count, [] {})) {
    ++front.leaves[forest.leaf[i].group].count;
  }
  uint16_t begin = 0;
  for (const uint32_t i : bounded<Profile::kGroups>(front.groups.used(), [] {})) {
    Span& span = front.leaves[front.groups.live(i)];
    const uint16_t count = span.count;
    span = Span{begin, 0};
    begin = static_cast<uint16_t>(begin + count);
  }
  for (const uint32_t i : bounded<Profile::kLeaves>(forest.leaf_count, [] {})) {
    Span& span = front.leaves[forest.leaf[i].group];
    front.leaf_order[span.begin + span.count] = static_cast<uint16_t>(i);
    ++span.count;
  }
  index_nodes(forest, front);
}

/// One group for each tet at `level`, or for a leaf above it. False when there are more of them than groups.
/// O(leaves x levels), at boot.
template <class Profile>
[[nodiscard]] bool make_groups(Forest<Profile>& forest, RotationFront<Profile>& front, uint8_t level) {
  front.groups.clear();
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
  for (const uint32_t at : leaves.take(front.leaves[group].begin, front.leaves[group].count)) {
    Leaf& leaf = forest.leaf[front.leaf_order[at]];
    if (child_towards(leaf, forest.level_of(tet)) == 1) leaf.group = added;
  }
  return added;
}

/// The inverse: `group` and `gone`, whose tets are siblings, become one on their parent, which keeps `group`.
template <class Profile, class Total>
void join_groups(Forest<Profile>& forest, RotationFront<Profile>& front, uint16_t group, uint16_t gone,
                 Total& leaves) {
  for (const uint32_t at : leaves.take(front.leaves[gone].begin, front.leaves[gone].count)) {
    forest.leaf[front.leaf_order[at]].group = group;
  }
  front.tet[group] = forest.parent_of(front.tet[group]);
  front.partner[group] = kNone;
  front.groups.release(gone);
}

}  // namespace palpate
