// What must always hold, checked leaf by leaf (so it can run in slices) or all at once. The mesh is
// conforming when every face is either shared by two leaves that name each other or lies on the surface of
// the block.
#pragma once

#include "palpate/mesh/forest.hpp"

namespace palpate {

enum class Violation : uint8_t {
  kNothing,
  kDeadNode,    // a leaf names a node that is not in use
  kWrongShape,  // a leaf is not the tet that its type, size and axes say
  kTreeLink,    // leaf, tet and pair do not name each other
  kNeighbour,   // a neighbour does not name the leaf back, or shares other nodes
  kHole,        // a face without neighbour is not on the surface: a hanging node
  kVolume,      // the leaves do not fill the block
  kMass,        // lumped masses do not add up
  kLeafCount,   // leaves and pairs do not fit together
  kNodeUse,     // a live node belongs to no leaf
  kPool         // a pool's lists are damaged
};

namespace invariants_detail {

/// g_k of the leaf at rest, one axis, in lattice steps.
template <class Profile>
int32_t rest_edge(const Forest<Profile>& forest, const Leaf& leaf, uint32_t k, uint32_t axis) {
  int32_t sum = 0;
  for (const uint32_t i : bounded<4>(4, [] {})) {
    const LatticePoint& w = forest.node.rest[leaf.node[i]];
    const int32_t coordinate = axis == 0 ? w.x : axis == 1 ? w.y : w.z;
    sum += kEdgeCoefficients[static_cast<uint32_t>(type_of_level(leaf.level()))][k][i] * coordinate;
  }
  return sum;
}

template <class Profile>
bool has_its_shape(const Forest<Profile>& forest, const Leaf& leaf) {
  const int32_t h = kLatticeStepsPerEdge >> size_of_level(leaf.level());
  bool right = true;
  for (const uint32_t k : bounded<3>(3, [] {})) {
    for (const uint32_t axis : bounded<3>(3, [] {})) {
      const int32_t along = leaf.axes().is_negative(k) ? -h : h;
      const int32_t expected = leaf.axes().axis(k) == axis ? along : 0;
      right = right && rest_edge(forest, leaf, k, axis) == expected;
    }
  }
  return right;
}

template <class Profile>
bool is_linked_in_tree(const Forest<Profile>& forest, uint32_t index) {
  const Leaf& leaf = forest.leaf[index];
  if (leaf.tet >= Forest<Profile>::kTets) return false;
  const Tet tet = forest.tet[leaf.tet];
  if (!tet.is_leaf() || tet.link() != index || forest.level_of(leaf.tet) != leaf.level()) return false;
  if (!forest.pairs.is_live(leaf.tet >> 1)) return false;
  const uint16_t parent = forest.parent_of(leaf.tet);
  if (parent == kNone) return leaf.level() == 0;
  return parent < Forest<Profile>::kTets && !forest.tet[parent].is_leaf() &&
         forest.tet[parent].link() == leaf.tet >> 1 && forest.level_of(parent) + 1 == leaf.level() &&
         forest.pairs.is_live(parent >> 1);
}

/// Whether all three nodes of the face opposite `face` are nodes of `other`.
inline bool shares_face(const Leaf& leaf, uint32_t face, const Leaf& other) {
  uint32_t shared = 0;
  for (const uint32_t i : bounded<4>(4, [] {})) {
    for (const uint32_t j : bounded<4>(4, [] {})) {
      shared += i != face && leaf.node[i] == other.node[j] ? 1u : 0u;
    }
  }
  return shared == 3;
}

/// Whether the cube around a face's outer side is absent: the face lies in one plane of the cubes' grid, and
/// the cube beyond it is not part of the block.
template <class Profile>
bool is_on_surface(const Forest<Profile>& forest, const Block& block, const Leaf& leaf, uint32_t face) {
  const LatticePoint corner = block.corner(0, 0, 0);
  const LatticePoint& top = forest.node.rest[leaf.node[face]];
  const int32_t apex[3] = {top.x - corner.x, top.y - corner.y, top.z - corner.z};
  int32_t sum[3] = {0, 0, 0};
  int32_t low[3] = {0x7fff, 0x7fff, 0x7fff};
  int32_t high[3] = {-0x7fff, -0x7fff, -0x7fff};
  for (const uint32_t i : bounded<4>(4, [] {})) {
    if (i == face) continue;
    const LatticePoint& p = forest.node.rest[leaf.node[i]];
    const int32_t at[3] = {p.x - corner.x, p.y - corner.y, p.z - corner.z};
    for (const uint32_t axis : bounded<3>(3, [] {})) {
      sum[axis] += at[axis];
      low[axis] = at[axis] < low[axis] ? at[axis] : low[axis];
      high[axis] = at[axis] > high[axis] ? at[axis] : high[axis];
    }
  }
  for (const uint32_t normal : bounded<3>(3, [] {})) {
    if (low[normal] != high[normal] || low[normal] % kLatticeStepsPerEdge != 0) continue;
    int32_t cube[3] = {0, 0, 0};
    for (const uint32_t axis : bounded<3>(3, [] {})) cube[axis] = sum[axis] / (3 * kLatticeStepsPerEdge);
    cube[normal] = low[normal] / kLatticeStepsPerEdge - (apex[normal] > low[normal] ? 1 : 0);
    if (cube[normal] < 0 || cube[normal] >= block.cubes[normal]) return true;
    const int32_t index = cube[0] + block.cubes[0] * (cube[1] + block.cubes[1] * cube[2]);
    return block.region[index] == Block::kAbsent;
  }
  return false;
}

template <class Profile>
Violation check_neighbours(const Forest<Profile>& forest, const Block& block, const Leaf& leaf) {
  for (const uint32_t face : bounded<4>(4, [] {})) {
    const uint16_t beyond = leaf.neighbour[face];
    if (beyond == kNone) {
      if (!is_on_surface(forest, block, leaf, face)) return Violation::kHole;
      continue;
    }
    if (beyond >= Forest<Profile>::kTets || !forest.tet[beyond].is_leaf() || beyond == leaf.tet ||
        forest.tet[beyond].link() >= forest.leaf_count) {
      return Violation::kNeighbour;
    }
    const Leaf& other = forest.leaf_of(beyond);
    if (other.tet != beyond || other.neighbour[face_towards(other, leaf.tet)] != leaf.tet ||
        !shares_face(leaf, face, other)) {
      return Violation::kNeighbour;
    }
  }
  return Violation::kNothing;
}

}  // namespace invariants_detail

/// Everything that one leaf can tell. Constant time; reads up to four neighbours.
template <class Profile>
[[nodiscard]] Violation check_leaf(const Forest<Profile>& forest, const Block& block, uint32_t index) {
  namespace detail = invariants_detail;
  const Leaf& leaf = forest.leaf[index];
  for (const uint32_t i : bounded<4>(4, [] {})) {
    if (!forest.nodes.is_live(leaf.node[i])) return Violation::kDeadNode;
  }
  if (!detail::is_linked_in_tree(forest, index)) return Violation::kTreeLink;
  if (!detail::has_its_shape(forest, leaf)) return Violation::kWrongShape;
  return detail::check_neighbours(forest, block, leaf);
}

/// Sums over all leaves, nodes and pools: volume, mass, counts, use of nodes, free lists.
template <class Profile>
[[nodiscard]] Violation check_totals(const Forest<Profile>& forest, const Block& block);

/// All of it: O(leaves + nodes).
template <class Profile>
[[nodiscard]] Violation check_forest(const Forest<Profile>& forest, const Block& block) {
  for (const uint32_t i : bounded<Profile::kLeaves>(forest.leaf_count, [] {})) {
    const Violation violation = check_leaf(forest, block, i);
    if (violation != Violation::kNothing) return violation;
  }
  return check_totals(forest, block);
}

template <class Profile>
Violation check_totals(const Forest<Profile>& forest, const Block& block) {
  if (!forest.pairs.is_whole() || !forest.nodes.is_whole()) return Violation::kPool;
  uint32_t roots = 0;
  uint64_t expected_mass = 0;
  for (const uint32_t i : bounded<kMaxCubes>(block.cube_count(), [] {})) {
    if (block.region[i] == Block::kAbsent) continue;
    roots += kRootsPerCube;
    expected_mass += uint64_t{kRootsPerCube} * 4 * quarter_mass(0, forest.region_density[block.region[i]]);
  }
  if (forest.leaf_count != forest.pairs.used() + roots / 2 || forest.leaf_count % 2 != 0) {
    return Violation::kLeafCount;
  }
  uint32_t volume = 0;  // in level-15 tets
  std::array<bool, Profile::kNodes> used{};
  for (const uint32_t i : bounded<Profile::kLeaves>(forest.leaf_count, [] {})) {
    volume += uint32_t{1} << (kMassLevels - forest.leaf[i].level());
    for (const uint32_t j : bounded<4>(4, [] {})) used[forest.leaf[i].node[j]] = true;
  }
  if (volume != roots << kMassLevels) return Violation::kVolume;
  uint64_t mass = 0;
  for (const uint32_t i : bounded<Profile::kNodes>(forest.nodes.used(), [] {})) {
    const uint16_t node = forest.nodes.live(i);
    if (!used[node]) return Violation::kNodeUse;
    mass += forest.node.mass[node];
  }
  return mass == expected_mass ? Violation::kNothing : Violation::kMass;
}

}  // namespace palpate
