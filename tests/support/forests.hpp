// Forests for tests: profiles, blocks, and what two forests with the same mesh have in common.
#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "palpate/mesh/invariants.hpp"
#include "palpate/mesh/make_forest.hpp"

namespace palpate::test {

template <uint16_t Leaves, uint16_t Nodes, uint8_t MaxLevel>
struct TestProfile {
  static constexpr const char* kName = "test";
  static constexpr uint16_t kLeaves = Leaves;
  static constexpr uint16_t kNodes = Nodes;
  static constexpr uint16_t kGroups = Leaves < 12000 ? Leaves : 12000;
  static constexpr uint8_t kMaxLevel = MaxLevel;
  static constexpr uint32_t kPatches = 4;
  static constexpr uint32_t kTetsSplit = 32;
  static constexpr uint32_t kTetsMerged = 32;
  static constexpr uint32_t kRotationChanges = 64;
  static constexpr uint16_t kTethers = 64;
  static constexpr uint32_t kSubsteps = 8;
  static constexpr uint32_t kContactCandidates = 64;
  static constexpr bool kStudyCriteria = true;
};

/// A profile with a group for every leaf, as full corotation needs, and any number of substeps.
template <class Profile>
struct WithFullCorotation : Profile {
  static constexpr uint16_t kGroups = Profile::kLeaves;
  static constexpr uint32_t kSubsteps = 8;
  static constexpr bool kStudyCriteria = true;
};

using Bar = TestProfile<1152, 512, 9>;
using Deep = TestProfile<30000, 9000, 14>;

inline constexpr std::array<uint16_t, kRegions> kOneDensity = {2048, 2048, 2048, 2048,
                                                               2048, 2048, 2048, 2048};

inline Block full_block(uint8_t x, uint8_t y, uint8_t z) {
  Block block{};
  block.cubes[0] = x;
  block.cubes[1] = y;
  block.cubes[2] = z;
  for (uint8_t& region : block.region) region = Block::kAbsent;
  for (uint32_t i = 0; i < block.cube_count(); ++i) block.region[i] = 0;
  return block;
}

/// The paper's cuboid.
inline Block bar_block() { return full_block(1, 1, 3); }

/// 3 x 2 x 2 with a corner and a middle cube missing and two materials: concave edges, faces of all
/// directions.
inline Block notched_block() {
  Block block = full_block(3, 2, 2);
  block.region[0] = Block::kAbsent;
  block.region[4] = Block::kAbsent;
  block.region[10] = Block::kAbsent;
  block.region[2] = 1;
  block.region[8] = 1;
  return block;
}

template <class Profile>
std::unique_ptr<Forest<Profile>> roots_of(const Block& block,
                                          const std::array<uint16_t, kRegions>& density = kOneDensity) {
  auto forest = std::make_unique<Forest<Profile>>();
  if (make_roots(*forest, block, density) != MeshStatus::kDone) return nullptr;
  return forest;
}

template <class Profile>
std::unique_ptr<Forest<Profile>> copy_of(const Forest<Profile>& forest) {
  auto copy = std::make_unique<Forest<Profile>>();
  std::memcpy(static_cast<void*>(copy.get()), static_cast<const void*>(&forest), sizeof(forest));
  return copy;
}

using Point = std::tuple<int, int, int>;
using Corners = std::array<Point, 4>;

inline Point point_of(LatticePoint p) { return Point(p.x, p.y, p.z); }

/// A mesh without the order of its pools: leaves by their corners, with those of their neighbours, and masses
/// by place. Two forests with equal content are the same mesh.
struct Content {
  struct LeafContent {
    std::array<Corners, 4> neighbour;
    uint16_t axes;
    uint8_t level, region;
    friend bool operator==(const LeafContent& a, const LeafContent& b) {
      return std::tie(a.neighbour, a.axes, a.level, a.region) ==
             std::tie(b.neighbour, b.axes, b.level, b.region);
    }
  };
  std::map<Corners, LeafContent> leaf;
  std::map<Point, MassUnits> mass;
  friend bool operator==(const Content& a, const Content& b) { return a.leaf == b.leaf && a.mass == b.mass; }
};

template <class Profile>
Corners corners_of(const Forest<Profile>& forest, const Leaf& leaf) {
  Corners corners;
  for (uint32_t i = 0; i < 4; ++i) corners[i] = point_of(forest.node.rest[leaf.node[i]]);
  return corners;
}

template <class Profile>
Content content_of(const Forest<Profile>& forest) {
  Content content;
  for (uint32_t i = 0; i < forest.leaf_count; ++i) {
    const Leaf& leaf = forest.leaf[i];
    Content::LeafContent part{{}, leaf.axes().code(), leaf.level(), leaf.region()};
    for (uint32_t face = 0; face < 4; ++face) {
      if (leaf.neighbour[face] == kNone) continue;
      part.neighbour[face] = corners_of(forest, forest.leaf_of(leaf.neighbour[face]));
    }
    content.leaf[corners_of(forest, leaf)] = part;
  }
  for (uint32_t i = 0; i < forest.nodes.used(); ++i) {
    const uint16_t node = forest.nodes.live(i);
    content.mass[point_of(forest.node.rest[node])] = forest.node.mass[node];
  }
  return content;
}

/// Merges until no more patch can be merged.
template <class Profile>
uint32_t merge_all(Forest<Profile>& forest) {
  uint32_t merges = 0;
  for (uint8_t level = Profile::kMaxLevel; level > 0; --level) {
    for (uint32_t i = 0; i < forest.leaf_count;) {
      Patch patch{};
      if (forest.leaf[i].level() != level ||
          find_merge(forest, forest.leaf[i].tet, patch) != MeshStatus::kDone) {
        ++i;
        continue;
      }
      merge(forest, patch);
      ++merges;
      i = 0;
    }
  }
  return merges;
}

/// Bisects the leaf tet `wanted`, coarser patches first. Returns the patches it took, 0 if it was refused.
template <class Profile>
uint32_t bisect_with_closure(Forest<Profile>& forest, uint16_t wanted, uint32_t* tets = nullptr) {
  uint32_t patches = 0;
  while (forest.tet[wanted].is_leaf()) {
    Patch patch{};
    if (find_ready_patch(forest, wanted, patch) != MeshStatus::kDone) return 0;
    if (bisect(forest, patch) != MeshStatus::kDone) return 0;
    ++patches;
    if (tets != nullptr) *tets += patch.count;
  }
  return patches;
}

}  // namespace palpate::test
