// The bisection forest: a binary tree under every root tet. Leaves are the simulation mesh and carry vertices
// and neighbours; internal tets keep only their child pair. Tets live in sibling pairs (2p, 2p + 1), so a
// sibling is one bit away, and parent and level are stored once a pair. Leaves are dense: leaf[0 ..
// leaf_count).
//
// Forest holds the data and the questions about it; bisect and merge are in patch.hpp, construction in
// make_forest.hpp, checks in invariants.hpp.
#pragma once

#include "palpate/mesh/leaf.hpp"
#include "palpate/mesh/node_state.hpp"
#include "palpate/mesh/sibling_pairs.hpp"

namespace palpate {

/// Where a tet goes on: 15 bits and, in the top one, whether it is a leaf.
class Tet {
 public:
  static constexpr uint16_t kMostLinks = 0x8000;

  Tet() = default;
  static constexpr Tet leaf(uint32_t place) { return Tet(kLeafBit | place); }
  static constexpr Tet internal(uint32_t child_pair) { return Tet(child_pair); }

  [[nodiscard]] constexpr bool is_leaf() const { return (code_ & kLeafBit) != 0; }
  /// A leaf's place in `leaf`, or an internal tet's child pair.
  [[nodiscard]] constexpr uint16_t link() const { return static_cast<uint16_t>(code_ & ~kLeafBit); }

 private:
  static constexpr uint32_t kLeafBit = kMostLinks;
  constexpr explicit Tet(uint32_t code) : code_(static_cast<uint16_t>(code)) {}
  uint16_t code_;
};

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
  static_assert(kLeaves <= Tet::kMostLinks && kPairs <= Tet::kMostLinks, "palpate: a tet links in 15 bits");

  SiblingPairs<kPairs> pairs;
  std::array<Tet, kTets> tet;

  // Even: of a cube there are six roots, and of each cube around an edge two or six tets are split with it.
  uint16_t leaf_count;
  PoolCounters leaf_counters;
  std::array<Leaf, kLeaves> leaf;

  IndexPool<kNodes> nodes;
  NodeState<kNodes> node;
  std::array<uint16_t, kRegions> region_density;  // in 1/kDensityOne of the largest

  /// Whether `count` more leaves fit; if not, that is counted as one refusal.
  [[nodiscard]] bool has_room_for_leaves(uint32_t count) {
    return leaf_counters.has_room(leaf_count, count, kLeaves);
  }
  [[nodiscard]] Leaf& leaf_of(uint16_t t) { return leaf[tet[t].link()]; }
  [[nodiscard]] const Leaf& leaf_of(uint16_t t) const { return leaf[tet[t].link()]; }
  /// kNone for roots.
  [[nodiscard]] uint16_t parent_of(uint16_t t) const { return pairs.parent(t >> 1); }
  [[nodiscard]] uint8_t level_of(uint16_t t) const { return pairs.level(t >> 1); }
  [[nodiscard]] static constexpr uint16_t sibling(uint16_t t) { return t ^ 1u; }
  [[nodiscard]] uint16_t child(uint16_t t, uint32_t which) const {
    return static_cast<uint16_t>(2u * tet[t].link() + which);
  }
};

}  // namespace palpate
