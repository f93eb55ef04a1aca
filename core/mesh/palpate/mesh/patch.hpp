// Patches: the atomic change of the mesh. A patch is all leaves around one refinement edge, at most kMaxPatch
// of them; they are bisected together or not at all, so the mesh conforms after every call. Merging is the
// exact inverse.
//
//   find_patch   collects the leaves around the refinement edge of a leaf; O(patch)
//   bisect       splits a ready patch at one new node; checks every slot before it changes anything
//   find_merge   collects the parents whose children all meet at one midpoint
//   merge        joins them and removes the node
#pragma once

#include "palpate/mesh/forest.hpp"
#include "palpate/numeric/all_of.hpp"

namespace palpate {

inline constexpr uint32_t kMaxPatch = 8;

struct Patch {
  std::array<uint16_t, kMaxPatch> tet;  // the tets to bisect, or the parents to restore
  uint32_t count;
  uint16_t blocker;  // with kNotReady: the coarser leaf that must be bisected first
};

/// How many tets the patches of a turn may have, all together: a total for each loop over them. `Of` tells
/// totals apart that are made side by side.
template <uint32_t MostTets, class Of>
struct PatchTotals {
  struct Changed {};
  struct Connected {};
  struct Noted {};
  BoundedTotal<MostTets, Changed> changed{Changed{}};
  BoundedTotal<MostTets, Connected> connected{Connected{}};
  BoundedTotal<MostTets, Noted> noted{Noted{}};  // by whom the patch is changed for

  [[nodiscard]] constexpr uint32_t left() const { return changed.left(); }
};

using EdgeEnds = std::array<uint16_t, 2>;

/// The edge that a bisection of this leaf halves.
inline EdgeEnds refinement_edge(const Leaf& leaf) {
  return EdgeEnds{leaf.node[0], leaf.node[refinement_end(type_of_level(leaf.level()))]};
}

/// The node that the bisection of this leaf's parent made. Not for a root.
inline uint16_t middle_node(const Leaf& leaf) {
  return leaf.node[refinement_end(type_of_level(static_cast<uint8_t>(leaf.level() - 1)))];
}

/// The edge that merging the children of `parent`, which are leaves, restores.
template <class Profile>
EdgeEnds restored_edge(const Forest<Profile>& forest, uint16_t parent) {
  const uint32_t end = refinement_end(type_of_level(forest.level_of(parent)));
  return EdgeEnds{forest.leaf_of(forest.child(parent, 0)).node[0],
                  forest.leaf_of(forest.child(parent, 1)).node[end - 1]};
}

/// Collects into patch.tet the leaves around an edge of leaf tet `start`, which has it between its places 0
/// and `end`. `accepts(leaf)` must hold for each; the first that fails becomes the blocker. Of those that it
/// holds for, `faces(tet, leaf)` are the two that hold the edge.
template <class Profile, class Accepts, class Faces>
[[nodiscard]] MeshStatus walk_around_edge(const Forest<Profile>& forest, uint16_t start, uint32_t end,
                                          Patch& patch, Accepts accepts, Faces faces) {
  const Leaf& first = forest.leaf_of(start);
  patch.tet[0] = start;
  patch.blocker = kNone;
  uint32_t count = 1;
  uint16_t from = start;
  uint16_t next = first.neighbour[others(end).first];
  bool second_way = false;
  for ([[maybe_unused]] const uint32_t step : bounded<kMaxPatch + 1>(kMaxPatch + 1, [] {})) {
    const bool is_surface = next == kNone;
    if (any_of(next == start, is_surface)) {
      patch.count = count;
      if (!all_of(is_surface, !second_way)) return MeshStatus::kDone;
      second_way = true;
      from = start;
      next = first.neighbour[others(end).second];
      continue;
    }
    const Leaf& leaf = forest.leaf_of(next);
    const EdgeOthers both = faces(next, leaf);
    const uint16_t one = leaf.neighbour[both.first], other = leaf.neighbour[both.second];
    const bool is_full = count == kMaxPatch;
    check(!is_full || !accepts(leaf), "a patch has more than kMaxPatch tets");
    if (any_of(is_full, !accepts(leaf))) {
      patch.count = count;
      patch.blocker = next;
      return MeshStatus::kNotReady;
    }
    patch.tet[count] = next;
    ++count;
    const uint16_t behind = one == from ? other : one;
    from = next;
    next = behind;
  }
  patch.count = count;
  check(false, "the walk around an edge did not close");
  return MeshStatus::kNotReady;
}

/// All leaves around the refinement edge of leaf tet `start`. With kNotReady, patch.blocker is the first
/// coarser leaf. A leaf of the same level has the edge as its refinement edge too: no other one is as long.
template <class Profile>
[[nodiscard]] MeshStatus find_patch(const Forest<Profile>& forest, uint16_t start, Patch& patch) {
  const Leaf& first = forest.leaf_of(start);
  if (first.level() >= Profile::kMaxLevel) return MeshStatus::kLevelLimit;
  const uint8_t level = first.level();
  const uint32_t end = refinement_end(type_of_level(level));
  const EdgeOthers faces = others(end);
  return walk_around_edge(
      forest, start, end, patch, [=](const Leaf& leaf) { return leaf.level() == level; },
      [=](uint16_t, const Leaf&) { return faces; });
}

/// The patch to bisect next so that leaf tet `wanted` can be bisected: its own if ready, else a coarser one
/// that stands in its way. Each step of the descent goes at least one level up, so there are kMaxLevel + 1 at
/// most. `steps` is a BoundedTotal of them: kNotReady when it has none left.
template <class Profile, class Total>
[[nodiscard]] MeshStatus find_ready_patch(const Forest<Profile>& forest, uint16_t wanted, Patch& patch,
                                          Total& steps) {
  MeshStatus status = MeshStatus::kNotReady;
  patch.blocker = wanted;
  for ([[maybe_unused]] const uint32_t level :
       bounded<Profile::kMaxLevel + 1u>(Profile::kMaxLevel + 1u, [] {})) {
    if (status != MeshStatus::kNotReady || steps.left() == 0) break;
    for ([[maybe_unused]] const uint32_t step : steps.take(0, 1)) {
      status = find_patch(forest, patch.blocker, patch);
    }
  }
  return status;
}

template <class Profile>
[[nodiscard]] MeshStatus find_ready_patch(const Forest<Profile>& forest, uint16_t wanted, Patch& patch) {
  auto steps = bounded_total<Profile::kMaxLevel + 1u>([] {});
  return find_ready_patch(forest, wanted, patch, steps);
}

/// The parents around the edge whose midpoint leaf tet `start` was made with, if all their children are
/// leaves.
template <class Profile>
[[nodiscard]] MeshStatus find_merge(const Forest<Profile>& forest, uint16_t start, Patch& patch) {
  const uint16_t first_parent = forest.parent_of(start);
  if (first_parent == kNone) return MeshStatus::kNotMergeable;
  const uint16_t first = forest.child(first_parent, 0);
  if (!forest.tet[first].is_leaf()) return MeshStatus::kNotMergeable;
  const uint8_t level = forest.level_of(first);
  const uint32_t end = refinement_end(type_of_level(static_cast<uint8_t>(level - 1)));
  const uint16_t middle = middle_node(forest.leaf_of(first));
  // A first child has the edge's end at place 0, a second child at the one before the middle's.
  const EdgeOthers of_first = others(end);
  const EdgeOthers of_second = EdgeOthers{end == 1 ? 2u : 0u, end == 3 ? 1u : 3u};
  const MeshStatus status = walk_around_edge(
      forest, first, end, patch,
      [=](const Leaf& leaf) { return all_of(leaf.level() == level, leaf.node[end] == middle); },
      [=](uint16_t tet, const Leaf&) {
        const bool is_second = (tet & 1u) != 0;
        return EdgeOthers{is_second ? of_second.first : of_first.first,
                          is_second ? of_second.second : of_first.second};
      });
  if (status != MeshStatus::kDone) return MeshStatus::kNotMergeable;
  for (const uint32_t i : bounded<kMaxPatch>(patch.count, [] {})) {
    if (!forest.tet[Forest<Profile>::sibling(patch.tet[i])].is_leaf()) return MeshStatus::kNotMergeable;
    patch.tet[i] = forest.parent_of(patch.tet[i]);
  }
  return MeshStatus::kDone;
}

/// Splits the leaves of a patch from find_patch or find_ready_patch at the midpoint of their edge. The new
/// node takes the mean position and velocity of the edge's ends. Changes nothing unless it returns kDone.
/// `totals` has the patch's tets left.
template <class Profile, class Totals>
[[nodiscard]] MeshStatus bisect(Forest<Profile>& forest, const Patch& patch, Totals& totals);
template <class Profile>
[[nodiscard]] MeshStatus bisect(Forest<Profile>& forest, const Patch& patch) {
  PatchTotals<kMaxPatch, Patch> totals;
  return bisect(forest, patch, totals);
}

/// The inverse of bisect for a patch from find_merge: the parents become leaves, the middle node goes. Of
/// each gap that this makes among the leaves `moved(gap, from)` is told, which leaf fills it.
template <class Profile, class Totals, class Moved>
void merge(Forest<Profile>& forest, const Patch& patch, Totals& totals, Moved moved);
template <class Profile>
void merge(Forest<Profile>& forest, const Patch& patch) {
  PatchTotals<kMaxPatch, Patch> totals;
  merge(forest, patch, totals, [](uint16_t, uint16_t) {});
}

}  // namespace palpate

#include "palpate/mesh/patch_change.hpp"
