// bisect and merge of patch.hpp: what they do to tets, leaves, neighbours, nodes and lumped masses.
#pragma once

#include "palpate/mesh/patch.hpp"

namespace palpate {
namespace patch_change {

/// Half of a parent's quarter mass moves from each end of the edge to the midpoint (+1), or back (-1).
template <class Profile>
void move_mass(Forest<Profile>& forest, const Leaf& parent, uint16_t middle, bool to_middle) {
  const uint32_t end = refinement_end(type_of_level(parent.level()));
  const MassUnits half = quarter_mass(parent.level(), forest.region_density[parent.region()]) / 2;
  auto& mass = forest.node.mass;
  const MassUnits change = to_middle ? half : 0 - half;
  mass[parent.node[0]] -= change;
  mass[parent.node[end]] -= change;
  mass[middle] += 2 * change;
}

inline void point_back(Leaf& outer, uint16_t from, uint16_t to) {
  outer.neighbour[face_towards(outer, from)] = to;
}

/// Children of one parent. Across the two faces that hold the edge their neighbours are still the parent's,
/// which connect_across mends when all parents of the patch are split.
template <class Profile>
void split_tet(Forest<Profile>& forest, uint16_t parent, uint16_t middle) {
  const uint16_t slot0 = forest.tet[parent].link();
  const Leaf old = forest.leaf[slot0];
  const uint32_t end = refinement_end(type_of_level(old.level()));
  const uint16_t pair = forest.pairs.take(parent, static_cast<uint8_t>(old.level() + 1));
  const auto child0 = static_cast<uint16_t>(2 * pair);
  const auto child1 = static_cast<uint16_t>(2 * pair + 1);
  const uint16_t slot1 = forest.leaf_count;
  ++forest.leaf_count;
  forest.tet[parent] = Tet::internal(pair);
  forest.tet[child0] = Tet::leaf(slot0);
  forest.tet[child1] = Tet::leaf(slot1);

  Leaf& leaf0 = forest.leaf[slot0];
  leaf0.node[end] = middle;
  leaf0.neighbour[0] = child1;
  leaf0.tet = child0;
  leaf0.kind = old.kind.child(0);

  Leaf& leaf1 = forest.leaf[slot1];
  leaf1 = old;
  for (const uint32_t i : bounded<3>(end, [] {})) {
    leaf1.node[i] = old.node[i + 1];
    leaf1.neighbour[i] = old.neighbour[i + 1];
  }
  leaf1.node[end] = middle;
  leaf1.neighbour[end] = old.neighbour[0];
  leaf1.neighbour[end - 1] = child0;
  leaf1.tet = child1;
  leaf1.kind = old.kind.child(1);

  if (old.neighbour[end] != kNone) point_back(forest.leaf_of(old.neighbour[end]), parent, child0);
  if (old.neighbour[0] != kNone) point_back(forest.leaf_of(old.neighbour[0]), parent, child1);
  move_mass(forest, old, middle, true);
}

/// The child of `parent` (0 or 1) that kept the node `edge_end`.
template <class Profile>
uint16_t child_with(const Forest<Profile>& forest, uint16_t parent, uint16_t edge_end) {
  const uint16_t child0 = forest.child(parent, 0);
  return forest.leaf_of(child0).node[0] == edge_end ? child0 : forest.child(parent, 1);
}

template <class Profile>
void connect_across(Forest<Profile>& forest, uint16_t parent) {
  const uint32_t end = refinement_end(type_of_level(forest.level_of(parent)));
  const EdgeOthers other = others(end);
  Leaf& leaf0 = forest.leaf_of(forest.child(parent, 0));
  Leaf& leaf1 = forest.leaf_of(forest.child(parent, 1));
  for (const uint32_t i : bounded<2>(2, [] {})) {
    const uint32_t face0 = i == 0 ? other.first : other.second;
    const uint32_t face1 = face0 < end ? face0 - 1 : face0;
    const uint16_t beyond = leaf0.neighbour[face0];
    if (beyond == kNone) continue;
    leaf0.neighbour[face0] = child_with(forest, beyond, leaf0.node[0]);
    leaf1.neighbour[face1] = child_with(forest, beyond, leaf1.node[end - 1]);
  }
}

/// Across the two faces that hold the edge the first child, whose slot is to be the parent's, names a child
/// of the parent's neighbour: name that neighbour, while all parents of the patch still have their children.
template <class Profile>
void reconnect_across(Forest<Profile>& forest, uint16_t parent) {
  const EdgeOthers other = others(refinement_end(type_of_level(forest.level_of(parent))));
  Leaf& leaf0 = forest.leaf_of(forest.child(parent, 0));
  for (const uint32_t i : bounded<2>(2, [] {})) {
    uint16_t& beyond = leaf0.neighbour[i == 0 ? other.first : other.second];
    if (beyond != kNone) beyond = forest.parent_of(beyond);
  }
}

/// The parent becomes a leaf again in its first child's slot; its second child's slot is filled by the last
/// leaf, from the place that is behind all leaves then. Returns that slot.
template <class Profile>
uint16_t join_tet(Forest<Profile>& forest, uint16_t parent, uint16_t middle) {
  const uint16_t pair = forest.tet[parent].link();
  const Leaf leaf0 = forest.leaf_of(static_cast<uint16_t>(2 * pair));
  const Leaf leaf1 = forest.leaf_of(static_cast<uint16_t>(2 * pair + 1));
  const uint16_t slot0 = forest.tet[leaf0.tet].link();
  const uint16_t slot1 = forest.tet[leaf1.tet].link();
  const LeafKind kind = leaf0.kind.parent();
  const uint32_t end = refinement_end(type_of_level(kind.level()));

  Leaf& whole = forest.leaf[slot0];
  whole.tet = parent;
  whole.kind = kind;
  whole.node[end] = leaf1.node[end - 1];
  whole.neighbour[0] = leaf1.neighbour[end];
  forest.tet[parent] = Tet::leaf(slot0);
  if (leaf0.neighbour[end] != kNone) point_back(forest.leaf_of(leaf0.neighbour[end]), leaf0.tet, parent);
  if (leaf1.neighbour[end] != kNone) point_back(forest.leaf_of(leaf1.neighbour[end]), leaf1.tet, parent);
  move_mass(forest, whole, middle, false);

  --forest.leaf_count;
  const Leaf last = forest.leaf[forest.leaf_count];
  forest.leaf[slot1] = last;
  if (slot1 != forest.leaf_count) forest.tet[last.tet] = Tet::leaf(slot1);
  forest.pairs.release(pair);
  return slot1;
}

template <class Profile>
uint16_t make_middle_node(Forest<Profile>& forest, uint16_t end0, uint16_t end1) {
  const uint16_t middle = forest.nodes.take();
  auto& node = forest.node;
  node.rest[middle] = midpoint(node.rest[end0], node.rest[end1]);
  node.mass[middle] = 0;
  node.force[middle] = zero_vector<Force>();
  for (const uint32_t axis : bounded<3>(3, [] {})) {
    const auto a = static_cast<int>(axis);
    const auto twice_position = widen<Position::kFractionBits>(node.position[end0][a]) +
                                widen<Position::kFractionBits>(node.position[end1][a]);
    const auto twice_velocity = widen<Velocity::kFractionBits>(node.velocity[end0][a]) +
                                widen<Velocity::kFractionBits>(node.velocity[end1][a]);
    node.position[middle][a] = narrow<Position>(divide_by_power_of_two<1>(twice_position));
    node.velocity[middle][a] = narrow<Velocity>(divide_by_power_of_two<1>(twice_velocity));
  }
  return middle;
}

}  // namespace patch_change

template <class Profile, class Totals>
MeshStatus bisect(Forest<Profile>& forest, const Patch& patch, Totals& totals) {
  if (!forest.has_room_for_leaves(patch.count)) return MeshStatus::kLeavesFull;
  if (!forest.pairs.has_room(patch.count)) return MeshStatus::kPairsFull;
  if (!forest.nodes.has_room(1)) return MeshStatus::kNodesFull;
  const EdgeEnds edge = refinement_edge(forest.leaf_of(patch.tet[0]));
  const uint16_t middle = patch_change::make_middle_node(forest, edge[0], edge[1]);
  for (const uint32_t i : totals.changed.take(0, patch.count)) {
    patch_change::split_tet(forest, patch.tet[i], middle);
  }
  for (const uint32_t i : totals.connected.take(0, patch.count)) {
    patch_change::connect_across(forest, patch.tet[i]);
  }
  forest.leaf_counters.note(forest.leaf_count);
  return MeshStatus::kDone;
}

template <class Profile, class Totals, class Moved>
void merge(Forest<Profile>& forest, const Patch& patch, Totals& totals, Moved moved) {
  const uint16_t middle = middle_node(forest.leaf_of(forest.child(patch.tet[0], 0)));
  for (const uint32_t i : totals.connected.take(0, patch.count)) {
    patch_change::reconnect_across(forest, patch.tet[i]);
  }
  for (const uint32_t i : totals.changed.take(0, patch.count)) {
    const uint16_t gap = patch_change::join_tet(forest, patch.tet[i], middle);
    moved(gap, forest.leaf_count);
  }
  check(forest.node.mass[middle] == 0, "a merged node keeps mass");
  forest.nodes.release(middle);
}

}  // namespace palpate
