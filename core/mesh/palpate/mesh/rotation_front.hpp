// The rotation front: the tets whose rotation is extracted, each a leaf or an ancestor of leaves. Such a tet
// with its leaves is a group; every leaf belongs to exactly one. Splitting a group puts its tet's two
// children on the front, joining is the inverse; neither changes the mesh.
//
// Leaves and nodes of a group lie side by side in leaf_order and node_order, which index_groups rebuilds
// after changes of the front or of the mesh. How many leaves a group has is kept up to date meanwhile. A
// group of n leaves has at most n + 3 nodes, so all lists are bounded.
#pragma once

#include "palpate/mesh/forest.hpp"
#include "palpate/numeric/opaque.hpp"

namespace palpate {

/// A part of leaf_order or node_order. A whole word, so that a copy needs no call.
struct alignas(uint32_t) Span {
  uint16_t begin;
  uint16_t count;

  /// Both at once, `begin` below: two halfwords would take a store each.
  [[nodiscard]] uint32_t word() const {
    uint32_t both;
    __builtin_memcpy(&both, __builtin_assume_aligned(this, sizeof both), sizeof both);
    return both;
  }
  void set_word(uint32_t both) {
    __builtin_memcpy(__builtin_assume_aligned(this, sizeof both), &both, sizeof both);
  }
  static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
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
  // Of each node, scratch: where the leaves of the group begin that named it last, while node_order is made;
  // how far its place in the frame is from the first one, in bytes, while a group's forces are computed.
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

/// The first half of index_groups: the leaves of each group, in their order. How many they are is known.
template <class Profile>
PALPATE_NOINLINE void index_leaves(const Forest<Profile>& forest, RotationFront<Profile>& front) {
  std::array<uint32_t, Profile::kGroups> next_of;  // of each group: where its next leaf goes
  uint32_t begin = 0;
  const auto start = [&](uint16_t group, uint32_t count) {
    front.leaves[group].set_word(begin | count << 16);
    next_of[group] = begin;
    begin += count;
  };
  // Here as below two at a time, since a load has to wait for the store before.
  const uint32_t used = front.groups.used();
#pragma GCC unroll 2
  for (const uint32_t pair : bounded<Profile::kGroups / 2>(used / 2, [] {})) {
    const uint16_t group0 = front.groups.live(2 * pair), group1 = front.groups.live(2 * pair + 1);
    uint32_t count0 = front.leaves[group0].count, count1 = front.leaves[group1].count;
    have_both(count0, count1);
    start(group0, count0);
    start(group1, count1);
  }
  for (const uint32_t i : bounded<1>(used % 2, [] {})) {
    const uint16_t group = front.groups.live(used - 1 - i);
    start(group, front.leaves[group].count);
  }
  const Leaf* const leaves = opaque(forest.leaf.data());
  uint16_t* const leaf_order = opaque(front.leaf_order.data());
  const auto put = [&](uint32_t place, uint32_t leaf) { leaf_order[place] = static_cast<uint16_t>(leaf); };
#pragma GCC unroll 2
  for (const uint32_t pair : bounded<Profile::kLeaves / 2>(forest.leaf_count / 2, [] {})) {
    const uint32_t first = 2 * pair;
    const uint32_t group0 = leaves[first].group;
    const uint32_t group1 = leaves[first + 1].group;
    const uint32_t place0 = next_of[group0];
    const uint32_t place1 = next_of[group1] + (group0 == group1 ? 1u : 0u);
    next_of[group0] = place0 + 1;
    next_of[group1] = place1 + 1;
    put(place0, first);
    put(place1, first + 1);
  }
}

/// The second half: the nodes of each group, in the order in which its leaves name them. One loop over the
/// leaves of all groups: a node is new in a group when one whose leaves are before, or none, named it last.
template <class Profile>
PALPATE_NOINLINE void index_nodes(const Forest<Profile>& forest, RotationFront<Profile>& front) {
  uint32_t* const named_by = opaque(front.mark.data());
  constexpr uint32_t kNobody = 0xffffffff;  // before all, as a number with a sign
#pragma GCC unroll 8
  for (const uint32_t i : bounded<Profile::kNodes>(Profile::kNodes, [] {})) named_by[i] = kNobody;
  const Leaf* const leaves = opaque(forest.leaf.data());
  const uint16_t* const leaf_order = opaque(front.leaf_order.data());
  uint16_t* const node_order = opaque(front.node_order.data());
  uint32_t end = 0;
  const auto add_leaf = [&](uint32_t place) {
    // All is loaded before anything is stored.
    const Leaf& leaf = leaves[place];
    const uint16_t group = leaf.group;
    const uint16_t node0 = leaf.node[0], node1 = leaf.node[1], node2 = leaf.node[2], node3 = leaf.node[3];
    const uint32_t begin = front.leaves[group].begin;
    // 1 for one that is new in this group, without a branch.
    const auto is_new = [=](uint16_t node) { return (named_by[node] - begin) >> 31; };
    const uint32_t at1 = end + is_new(node0);
    const uint32_t at2 = at1 + is_new(node1);
    const uint32_t at3 = at2 + is_new(node2);
    const uint32_t behind = at3 + is_new(node3);
    named_by[node0] = named_by[node1] = named_by[node2] = named_by[node3] = begin;
    // Written in any case, and overwritten unless it is new.
    node_order[end] = node0;
    node_order[at1] = node1;
    node_order[at2] = node2;
    node_order[at3] = node3;
    front.nodes[group].set_word(behind);
    end = behind;
  };
#pragma GCC unroll 2
  for (const uint32_t pair : bounded<Profile::kLeaves / 2>(forest.leaf_count / 2, [] {})) {
    uint32_t place0 = leaf_order[std::size_t{2} * pair], place1 = leaf_order[std::size_t{2} * pair + 1];
    have_both(place0, place1);
    add_leaf(place0);
    add_leaf(place1);
  }
  uint32_t begin = 0;
#pragma GCC unroll 2
  for (const uint32_t i : bounded<Profile::kGroups>(front.groups.used(), [] {})) {
    Span& nodes = front.nodes[front.groups.live(i)];
    const uint32_t behind = nodes.word();
    nodes.set_word(begin | (behind - begin) << 16);
    begin = behind;
  }
}

/// Rebuilds the lists of all groups from Leaf::group and the numbers of leaves, which changes of the front
/// and of the mesh keep up to date. O(leaves + nodes + groups).
template <class Profile>
void index_groups(const Forest<Profile>& forest, RotationFront<Profile>& front) {
  index_leaves(forest, front);
  index_nodes(forest, front);
}

/// The same where the numbers are not known.
template <class Profile>
void count_and_index_groups(const Forest<Profile>& forest, RotationFront<Profile>& front) {
  for (const uint32_t i : bounded<Profile::kGroups>(front.groups.used(), [] {})) {
    front.leaves[front.groups.live(i)].count = 0;
  }
  for (const uint32_t i : bounded<Profile::kLeaves>(forest.leaf_count, [] {})) {
    ++front.leaves[forest.leaf[i].group].count;
  }
  index_groups(forest, front);
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
  count_and_index_groups(forest, front);
  return true;
}

/// Steps that go through so many leaves of a group, two in each.
constexpr uint32_t steps_by_twos(uint32_t leaves) { return (leaves + 1) / 2; }

/// All leaves of a list: two at a time, so that a load waits for half of the stores, and one that is left.
/// `steps` is a BoundedTotal.
template <class Profile, class Total, class Two, class One>
PALPATE_ALWAYS_INLINE void by_twos(Forest<Profile>& forest, const RotationFront<Profile>& front, Span list,
                                   Total& steps, Two two, One one) {
  Leaf* const leaves = opaque(forest.leaf.data());
  const uint16_t* const order = opaque(front.leaf_order.data() + list.begin);
  for (const uint32_t pair : steps.take(0, list.count / 2u)) {
    two(leaves[order[std::size_t{2} * pair]], leaves[order[std::size_t{2} * pair + 1]]);
  }
  for ([[maybe_unused]] const uint32_t once : steps.take(0, list.count % 2u)) {
    one(leaves[order[list.count - 1u]]);
  }
}

/// Puts the children of a group's tet, which must not be a leaf, on the front in its place: the group keeps
/// child 0, a new one, which is returned, takes child 1. kNone, and nothing changed, when all groups are in
/// use. `steps` is a BoundedTotal that has steps_by_twos of the group's leaves left. Until index_groups the
/// lists are the old ones, but the numbers of leaves are those that they will have.
template <class Profile, class Total>
[[nodiscard]] uint16_t split_group(Forest<Profile>& forest, RotationFront<Profile>& front, uint16_t group,
                                   Total& steps) {
  const uint16_t added = front.groups.allocate();
  if (added == kNone) return kNone;
  const uint16_t tet = front.tet[group];
  front.tet[group] = forest.child(tet, 0);
  front.tet[added] = forest.child(tet, 1);
  front.partner[added] = kNone;
  const uint8_t level = forest.level_of(tet);
  const Span span = front.leaves[group];
  const uint32_t difference = uint32_t{added} - group;
  uint32_t moved = 0;
  const auto move = [&](Leaf& leaf, uint32_t towards) {
    leaf.group = static_cast<uint16_t>(group + towards * difference);
    moved += towards;
  };
  by_twos(
      forest, front, span, steps,
      [&](Leaf& leaf0, Leaf& leaf1) {
        uint32_t towards0 = child_towards(leaf0, level), towards1 = child_towards(leaf1, level);
        have_both(towards0, towards1);
        move(leaf0, towards0);
        move(leaf1, towards1);
      },
      [&](Leaf& leaf) { move(leaf, child_towards(leaf, level)); });
  front.leaves[group].count = static_cast<uint16_t>(span.count - moved);
  front.leaves[added].count = static_cast<uint16_t>(moved);
  return added;
}

/// The inverse: `group` and `gone`, whose tets are siblings, become one on their parent, which keeps `group`.
template <class Profile, class Total>
void join_groups(Forest<Profile>& forest, RotationFront<Profile>& front, uint16_t group, uint16_t gone,
                 Total& steps) {
  const Span span = front.leaves[gone];
  by_twos(
      forest, front, span, steps, [group](Leaf& leaf0, Leaf& leaf1) { leaf0.group = leaf1.group = group; },
      [group](Leaf& leaf) { leaf.group = group; });
  front.leaves[group].count = static_cast<uint16_t>(front.leaves[group].count + span.count);
  front.tet[group] = forest.parent_of(front.tet[group]);
  front.partner[group] = kNone;
  front.groups.release(gone);
}

}  // namespace palpate
