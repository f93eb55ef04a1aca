// When the two fronts change: part of a model, chosen on the host.
#pragma once

#include "palpate/mesh/block.hpp"
#include "palpate/numeric/q.hpp"

namespace palpate {

/// What makes a rotation tet too coarse.
enum class RotationCriterion : uint8_t {
  kFull,      // a group a leaf: full corotation; only two leaves about to be merged share one
  kSiblings,  // |R_m - R_n|_F^2 of the two halves of a parent (Tagawa et al., Eq. 3 to 5), conforming front
  kMisfit     // what splitting the group would gain (elastic/misfit.hpp)
};

/// Of the criteria for studies, which only a profile with kStudyCriteria has code for.
constexpr bool has_conforming_front(RotationCriterion criterion) {
  return criterion != RotationCriterion::kMisfit;
}

struct RotationRules {
  RotationCriterion criterion;
  uint8_t start_level;   // of the rotation tets at start
  uint32_t split_above;  // raw: of Q<4, 27> for siblings (F_max), of Misfit for misfits
  uint32_t join_below;   // the same (F_min)
};

/// What makes a leaf too coarse, as (l / l0)^2 - 1 of edges, or as a difference of Green strains.
enum class StretchCriterion : uint8_t {
  kFixed,        // the mesh stays as it is
  kLongestEdge,  // of the edge that would be bisected (ref. [9] of Tagawa et al.)
  kSixEdges,     // the largest of all edges
  kStrainJump    // twice the largest entry of the difference of Green strains to a neighbour across a face
};

/// As has_conforming_front: as dear as all other criteria together.
constexpr bool looks_at_neighbours(StretchCriterion criterion) {
  return criterion == StretchCriterion::kStrainJump;
}

/// Of a region's leaves; start() wants the level that the mesh starts at in it.
struct LevelRange {
  uint8_t least, most;
};

struct StretchRules {
  StretchCriterion criterion;
  Q<4, 27> split_above;
  Q<4, 27> merge_below;
  std::array<LevelRange, kRegions> levels;
};

struct RemeshRules {
  RotationRules rotation;
  StretchRules stretch;
};

/// What happened since start, and what could not.
struct RemeshCounters {
  uint32_t bisected, merged;  // tets
  uint32_t groups_split, groups_joined;
  uint16_t leaves_waiting, groups_waiting;  // in the last turn: wanted and not yet done
};

/// Why something had to wait in the last turn, one bit each; the names are of what to raise.
enum class RemeshFlag : uint32_t {
  kPatchBudget = 1u << 0,
  kRotationBudget = 1u << 1,
  kLeaves = 1u << 2,
  kNodes = 1u << 3,
  kGroups = 1u << 4,
  kTethers = 1u << 5,
};
inline constexpr uint32_t kRemeshFlags = 6;

}  // namespace palpate
