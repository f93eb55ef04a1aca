// Construction at boot: the root tets of a block of cubes, and uniform refinement. Not for the cycle.
#pragma once

#include "palpate/mesh/patch.hpp"

namespace palpate {
namespace make_forest_detail {

inline constexpr uint32_t kCorners = (kMaxCubesPerAxis + 1) * (kMaxCubesPerAxis + 1) * (kMaxCubesPerAxis + 1);

/// The axes along which the six Kuhn tets of a cube walk from its low to its high corner.
inline constexpr uint8_t kKuhnAxes[kRootsPerCube][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2},
                                                        {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};

struct CornerNodes {
  std::array<uint16_t, kCorners> node;
};

inline uint32_t corner_index(const uint32_t at[3]) {
  return at[0] + (kMaxCubesPerAxis + 1) * (at[1] + (kMaxCubesPerAxis + 1) * at[2]);
}

template <class Profile>
uint16_t corner_node(Forest<Profile>& forest, const Block& block, CornerNodes& corners,
                     const uint32_t at[3]) {
  uint16_t& known = corners.node[corner_index(at)];
  if (known != kNone) return known;
  known = forest.nodes.allocate();
  if (known == kNone) return kNone;
  const LatticePoint rest = block.corner(at[0], at[1], at[2]);
  forest.node.rest[known] = rest;
  forest.node.mass[known] = 0;
  forest.node.position[known] = rest_position(rest);
  forest.node.velocity[known] = zero_vector<Velocity>();
  forest.node.force[known] = zero_vector<Force>();
  return known;
}

/// Root tets come in sibling pairs too, with no parent: `pair` is that of the root before.
template <class Profile>
MeshStatus add_root(Forest<Profile>& forest, const Block& block, CornerNodes& corners, const uint32_t cube[3],
                    uint32_t which, uint8_t region, uint16_t& pair) {
  if (which % 2 == 0) pair = forest.pairs.allocate(kNone, 0);
  if (pair == kNone) return MeshStatus::kPairsFull;
  if (!forest.has_room_for_leaves(1)) return MeshStatus::kLeavesFull;
  const auto tet = static_cast<uint16_t>(2 * pair + which % 2);
  Leaf leaf{};
  leaf.tet = tet;
  leaf.group = kNone;
  leaf.kind = LeafKind(0, Axes::of(kKuhnAxes[which][0], kKuhnAxes[which][1], kKuhnAxes[which][2]), region, 0);
  uint32_t at[3] = {cube[0], cube[1], cube[2]};
  for (const uint32_t i : bounded<4>(4, [] {})) {
    if (i > 0) ++at[kKuhnAxes[which][i - 1]];
    leaf.node[i] = corner_node(forest, block, corners, at);
    leaf.neighbour[i] = kNone;
    if (leaf.node[i] == kNone) return MeshStatus::kNodesFull;
    forest.node.mass[leaf.node[i]] += quarter_mass(0, forest.region_density[region]);
  }
  forest.tet[tet] = Tet::leaf(forest.leaf_count);
  forest.leaf[forest.leaf_count] = leaf;
  ++forest.leaf_count;
  return MeshStatus::kDone;
}

/// Makes a and b neighbours if they share three nodes.
inline void connect_if_adjacent(Leaf& a, Leaf& b) {
  uint32_t shared = 0;
  uint32_t lone_a = 0 + 1 + 2 + 3;
  uint32_t lone_b = 0 + 1 + 2 + 3;
  for (const uint32_t i : bounded<4>(4, [] {})) {
    for (const uint32_t j : bounded<4>(4, [] {})) {
      if (a.node[i] != b.node[j]) continue;
      ++shared;
      lone_a -= i;
      lone_b -= j;
    }
  }
  if (shared != 3) return;
  a.neighbour[lone_a] = b.tet;
  b.neighbour[lone_b] = a.tet;
}

template <class Profile>
void connect_roots(Forest<Profile>& forest) {
  for (const uint32_t i : bounded<Profile::kLeaves>(forest.leaf_count, [] {})) {
    for (const uint32_t j : bounded<Profile::kLeaves>(i, [] {})) {
      connect_if_adjacent(forest.leaf[i], forest.leaf[j]);
    }
  }
}

}  // namespace make_forest_detail

/// Six root tets for every present cube; densities in 1/kDensityOne of the largest. O(roots^2).
template <class Profile>
[[nodiscard]] MeshStatus make_roots(Forest<Profile>& forest, const Block& block,
                                    const std::array<uint16_t, kRegions>& region_density) {
  namespace detail = make_forest_detail;
  forest.pairs.clear();
  forest.nodes.clear();
  forest.leaf_count = 0;
  forest.leaf_counters = PoolCounters{0, 0};
  forest.region_density = region_density;
  detail::CornerNodes corners{};
  for (const uint32_t i : bounded<detail::kCorners>(detail::kCorners, [] {})) corners.node[i] = kNone;
  for (const uint32_t index : bounded<kMaxCubes>(block.cube_count(), [] {})) {
    const uint8_t region = block.region[index];
    if (region == Block::kAbsent) continue;
    const uint32_t nx = block.cubes[0];
    const uint32_t ny = block.cubes[1];
    const uint32_t cube[3] = {index % nx, index / nx % ny, index / (nx * ny)};
    uint16_t pair = kNone;
    for (const uint32_t which : bounded<kRootsPerCube>(kRootsPerCube, [] {})) {
      const MeshStatus status = detail::add_root(forest, block, corners, cube, which, region, pair);
      if (status != MeshStatus::kDone) return status;
    }
  }
  detail::connect_roots(forest);
  forest.leaf_counters.peak = forest.leaf_count;
  return MeshStatus::kDone;
}

/// Bisects every leaf above `level` until all are at it.
template <class Profile>
[[nodiscard]] MeshStatus refine_uniformly(Forest<Profile>& forest, uint8_t level) {
  for (const uint32_t at_level : bounded<Profile::kMaxLevel>(level, [] {})) {
    for (const uint32_t i : bounded<Profile::kLeaves>(forest.leaf_count, [] {})) {
      if (forest.leaf[i].level() != at_level) continue;
      Patch patch{};
      MeshStatus status = find_patch(forest, forest.leaf[i].tet, patch);
      if (status == MeshStatus::kDone) status = bisect(forest, patch);
      if (status != MeshStatus::kDone) return status;
    }
  }
  return MeshStatus::kDone;
}

}  // namespace palpate
