// What must always hold for a rotation front whose lists are indexed, checked leaf by leaf and group by group
// (so it can run in slices) or all at once: every leaf lies in exactly one group, and the groups fill the
// block.
#pragma once

#include "palpate/mesh/rotation_front.hpp"

namespace palpate {

enum class FrontViolation : uint8_t {
  kNothing,
  kPool,       // the pool's lists are damaged
  kTet,        // a group's tet is not in use
  kLeafGroup,  // a leaf's group is not in use, or its tet neither is the leaf nor lies above it
  kPartner,    // a partner is not the sibling's group that names this one back
  kLeafList,   // the list of a group's leaves is not these leaves, each once, in order
  kCover,      // a group's leaves do not fill its tet
  kNodeList,   // the list of a group's nodes is not the nodes of its leaves, each once
  kSpans       // the lists do not lie side by side
};

namespace front_invariants_detail {

template <class Profile>
bool names_its_partner(const Forest<Profile>& forest, const RotationFront<Profile>& front, uint16_t group) {
  const uint16_t partner = front.partner[group];
  if (partner == kNone) return true;
  return front.groups.is_live(partner) && front.partner[partner] == group &&
         front.tet[partner] == Forest<Profile>::sibling(front.tet[group]) &&
         forest.parent_of(front.tet[group]) != kNone;
}

template <class Profile>
FrontViolation check_leaf_list(const Forest<Profile>& forest, const RotationFront<Profile>& front,
                               uint16_t group) {
  const Span span = front.leaves[group];
  if (span.count == 0 || uint32_t{span.begin} + span.count > forest.leaf_count)
    return FrontViolation::kLeafList;
  uint32_t volume = 0;  // in tets of the deepest level
  for (const uint32_t i : bounded<Profile::kLeaves>(span.count, [] {})) {
    const uint16_t at = front.leaf_order[span.begin + i];
    if (at >= forest.leaf_count || forest.leaf[at].group != group) return FrontViolation::kLeafList;
    if (i > 0 && front.leaf_order[span.begin + i - 1] >= at) return FrontViolation::kLeafList;
    volume += uint32_t{1} << (kDeepestLevel - forest.leaf[at].level());
  }
  const uint32_t whole = uint32_t{1} << (kDeepestLevel - forest.level_of(front.tet[group]));
  return volume == whole ? FrontViolation::kNothing : FrontViolation::kCover;
}

/// Needs a good leaf list.
template <class Profile>
bool has_its_nodes(const Forest<Profile>& forest, const RotationFront<Profile>& front, uint16_t group) {
  const Span span = front.nodes[group];
  using Front = RotationFront<Profile>;
  if (span.count > Front::kNodesOfGroup || uint32_t{span.begin} + span.count > Front::kGroupNodes)
    return false;
  std::array<bool, Profile::kNodes> listed{};
  for (const uint32_t i : bounded<Profile::kNodes>(span.count < Profile::kNodes ? span.count : 0u, [] {})) {
    const uint16_t node = front.node_order[span.begin + i];
    if (node >= Profile::kNodes || listed[node]) return false;
    listed[node] = true;
  }
  // Every node of a leaf is listed, and there are no more: as many as the leaves name for the first time.
  std::array<bool, Profile::kNodes> named{};
  uint32_t count = 0;
  for (const uint32_t i : bounded<Profile::kLeaves>(front.leaves[group].count, [] {})) {
    for (const uint32_t j : bounded<4>(4, [] {})) {
      const uint16_t node = forest.leaf[front.leaf_order[front.leaves[group].begin + i]].node[j];
      if (!listed[node]) return false;
      count += named[node] ? 0u : 1u;
      named[node] = true;
    }
  }
  return count == span.count;
}

}  // namespace front_invariants_detail

/// Whether a leaf's group is in use and on its tet or above it. O(levels).
template <class Profile>
[[nodiscard]] FrontViolation check_leaf_group(const Forest<Profile>& forest,
                                              const RotationFront<Profile>& front, uint32_t index) {
  const Leaf& leaf = forest.leaf[index];
  if (!front.groups.is_live(leaf.group)) return FrontViolation::kLeafGroup;
  const uint16_t tet = front.tet[leaf.group];
  if (tet >= Forest<Profile>::kTets || forest.level_of(tet) > leaf.level()) return FrontViolation::kLeafGroup;
  return ancestor_at(forest, leaf.tet, forest.level_of(tet)) == tet ? FrontViolation::kNothing
                                                                    : FrontViolation::kLeafGroup;
}

/// Everything that one group can tell. O(nodes + leaves of the group).
template <class Profile>
[[nodiscard]] FrontViolation check_group(const Forest<Profile>& forest, const RotationFront<Profile>& front,
                                         uint16_t group) {
  namespace detail = front_invariants_detail;
  const uint16_t tet = front.tet[group];
  if (tet >= Forest<Profile>::kTets || !forest.pairs.is_live(tet >> 1)) {
    return FrontViolation::kTet;
  }
  if (!detail::names_its_partner(forest, front, group)) return FrontViolation::kPartner;
  const FrontViolation leaves = detail::check_leaf_list(forest, front, group);
  if (leaves != FrontViolation::kNothing) return leaves;
  return detail::has_its_nodes(forest, front, group) ? FrontViolation::kNothing : FrontViolation::kNodeList;
}

/// Whether the lists of all groups lie side by side, in the order of the groups. O(groups).
template <class Profile>
[[nodiscard]] FrontViolation check_spans(const Forest<Profile>& forest, const RotationFront<Profile>& front) {
  if (!front.groups.is_whole()) return FrontViolation::kPool;
  uint32_t leaves = 0;
  uint32_t nodes = 0;
  bool side_by_side = true;
  for (const uint32_t i : bounded<Profile::kGroups>(front.groups.used(), [] {})) {
    const uint16_t group = front.groups.live(i);
    side_by_side = side_by_side && front.leaves[group].begin == leaves && front.nodes[group].begin == nodes;
    leaves += front.leaves[group].count;
    nodes += front.nodes[group].count;
  }
  side_by_side = side_by_side && leaves == forest.leaf_count && nodes <= leaves + 3u * front.groups.used();
  return side_by_side ? FrontViolation::kNothing : FrontViolation::kSpans;
}

/// All of it: O(groups x nodes + leaves x levels).
template <class Profile>
[[nodiscard]] FrontViolation check_front(const Forest<Profile>& forest, const RotationFront<Profile>& front) {
  if (!front.groups.is_whole()) return FrontViolation::kPool;
  for (const uint32_t i : bounded<Profile::kGroups>(front.groups.used(), [] {})) {
    const FrontViolation violation = check_group(forest, front, front.groups.live(i));
    if (violation != FrontViolation::kNothing) return violation;
  }
  for (const uint32_t i : bounded<Profile::kLeaves>(forest.leaf_count, [] {})) {
    const FrontViolation violation = check_leaf_group(forest, front, i);
    if (violation != FrontViolation::kNothing) return violation;
  }
  return check_spans(forest, front);
}

}  // namespace palpate
