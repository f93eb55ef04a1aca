// A conforming rotation front: all tets around one refinement edge are on it together or not at all, as in a
// patch of the mesh (patch.hpp). The tets of such a patch may be internal; they are found from the leaves
// around a piece of their edge.
#pragma once

#include "palpate/mesh/patch.hpp"
#include "palpate/mesh/rotation_front.hpp"

namespace palpate {

struct FrontPatch {
  std::array<uint16_t, kMaxPatch> tet;
  uint32_t count;
  uint16_t blocker;  // with kNotReady: the group whose coarser tet must be split first
};

namespace front_patch_detail {

inline void add_once(FrontPatch& patch, uint16_t tet) {
  for (const uint32_t i : bounded<kMaxPatch>(patch.count, [] {})) {
    if (patch.tet[i] == tet) return;
  }
  check(patch.count < kMaxPatch, "a front patch has more than kMaxPatch tets");
  patch.tet[patch.count] = tet;
  ++patch.count;
}

/// The two faces of a leaf that hold an edge; where it has none, of a broken mesh, some others.
inline EdgeOthers faces_at(const Leaf& leaf, uint16_t end0, uint16_t end1) {
  EdgeOthers faces{0, 0};
  for (const uint32_t face : bounded<4>(4, [] {})) {
    if (leaf.node[face] != end0 && leaf.node[face] != end1) faces = EdgeOthers{face, faces.first};
  }
  return faces;
}

}  // namespace front_patch_detail

/// The tets at the level of `tet`, an internal one, around its refinement edge. kNotReady when some of them
/// lie below coarser tets of the front; those are left out. O(8 x levels).
template <class Profile>
[[nodiscard]] MeshStatus find_front_patch(const Forest<Profile>& forest, const RotationFront<Profile>& front,
                                          uint16_t tet, FrontPatch& patch) {
  const uint8_t level = forest.level_of(tet);
  patch.count = 0;
  patch.blocker = kNone;
  // First children keep vertex 0, and the edge's middle takes the place of its end in the first of them:
  // further bisections halve the piece between these two places or leave it as it is.
  Patch around;
  const uint16_t start = first_leaf(forest, tet);
  const uint32_t end = refinement_end(type_of_level(level));
  const EdgeEnds edge{forest.leaf_of(start).node[0], forest.leaf_of(start).node[end]};
  const MeshStatus walk = walk_around_edge(
      forest, start, end, around, [](const Leaf&) { return true; },
      [=](uint16_t, const Leaf& leaf) { return front_patch_detail::faces_at(leaf, edge[0], edge[1]); });
  check(walk == MeshStatus::kDone, "the walk around a piece of an edge did not close");
  for (const uint32_t i : bounded<kMaxPatch>(around.count, [] {})) {
    const uint16_t group = forest.leaf_of(around.tet[i]).group;
    if (forest.level_of(front.tet[group]) < level) {
      patch.blocker = group;
      continue;
    }
    front_patch_detail::add_once(patch, ancestor_at(forest, around.tet[i], level));
  }
  return patch.blocker == kNone ? walk : MeshStatus::kNotReady;
}

}  // namespace palpate
