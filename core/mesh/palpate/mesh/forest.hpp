// The bisection forest: a binary tree under every root tet. Leaves are the simulation mesh and carry vertices
// and neighbours; internal tets keep only their child pair, parent and level. Tets live in sibling pairs (2p,
// 2p + 1), so a sibling is one bit away and a parent is stored once a pair. Leaves are dense: leaf[0 ..
// leaf_count).
//
// Forest holds the data and the questions about it; bisect and merge are in patch.hpp, construction in
// make_forest.hpp, checks in invariants.hpp.
#pragma once

#include "palpate/memory/index_pool.hpp"
#include "palpate/mesh/block.hpp"
#include "palpate/mesh/node_state.hpp"
#include "palpate/mesh/tet_shape.hpp"

namespace palpate {

struct Tet {
  uint16_t link;  // a leaf's place in `leaf`, or an internal tet's child pair
  uint8_t level;
  bool is_leaf;
};

/// Whole words to the last byte, so that a copy needs no call.
struct alignas(uint32_t) Leaf {
  std::array<uint16_t, 4> node;       // w0 .. w3 in bisection order (tet_shape.hpp)
  std::array<uint16_t, 4> neighbour;  // the leaf tet across the face opposite w_i, or kNone on the surface
  uint16_t tet;
  uint16_t group;  // whose rotation it uses
  uint16_t path;   // from its root: a bit a level, which child, the last one lowest
  Axes axes;
  uint8_t level;
  uint8_t region;
  uint16_t padding;
};

/// Which child of its ancestor at `level`, above its own, a leaf lies in.
inline uint32_t child_towards(const Leaf& leaf, uint8_t level) {
  return (static_cast<uint32_t>(leaf.path) >> (leaf.level - level - 1)) & 1u;
}

/// What a patch operation could not do. Nothing has changed then.
enum class MeshStatus : uint8_t {
  kDone,
  kNotReady,     // a tet around the edge is coarser; see the blocker
  kLevelLimit,   // the leaves are at the deepest level allowed
  kLeavesFull,   // no room for the new leaves
  kPairsFull,    // no room for the new sibling pairs
  kNodesFull,    // no room for the new node
  kNotMergeable  // a child is not a leaf, or the tet is a root
};

template <class Profile>
struct Forest {
  static constexpr uint16_t kLeaves = Profile::kLeaves;
  static constexpr uint16_t kNodes = Profile::kNodes;
  /// Sibling pairs, the roots' included: leaves - roots / 2, so never more than leaves.
  static constexpr uint16_t kPairs = Profile::kLeaves;
  static constexpr uint16_t kTets = static_cast<uint16_t>(2 * kPairs);
  static_assert(Profile::kMaxLevel <= kDeepestLevel, "palpate: levels end at kDeepestLevel");

  IndexPool<kPairs> pairs;
  std::array<uint16_t, kPairs> parent;  // of a pair, kNone for roots
  std::array<Tet, kTets> tet;

  uint16_t leaf_count;
  PoolCounters leaf_counters;
  std::array<Leaf, kLeaves> leaf;

  IndexPool<kNodes> nodes;
  NodeState<kNodes> node;
  std::array<uint16_t, kRegions> region_density;  // in 1/kDensityOne of the largest

  /// Whether `count` more leaves fit; if not, that is counted as one refusal.
  [[nodiscard]] bool has_room_for_leaves(uint32_t count) {
    const bool fits = leaf_count + count <= kLeaves;
    if (!fits && leaf_counters.refused < 0xffff) ++leaf_counters.refused;
    return fits;
  }
  [[nodiscard]] Leaf& leaf_of(uint16_t t) { return leaf[tet[t].link]; }
  [[nodiscard]] const Leaf& leaf_of(uint16_t t) const { return leaf[tet[t].link]; }
  [[nodiscard]] uint16_t parent_of(uint16_t t) const { return parent[t >> 1]; }
  [[nodiscard]] static constexpr uint16_t sibling(uint16_t t) { return t ^ 1u; }
  [[nodiscard]] uint16_t child(uint16_t t, uint32_t which) const {
    return static_cast<uint16_t>(2u * tet[t].link + which);
  }
};

/// Face (0 .. 3) that a leaf shares with a neighbouring tet.
inline uint32_t face_towards(const Leaf& leaf, uint16_t tet) {
  return leaf.neighbour[0] == tet ? 0u : leaf.neighbour[1] == tet ? 1u : leaf.neighbour[2] == tet ? 2u : 3u;
}

}  // namespace palpate
