// Profiles: all capacities and budgets of one build, fixed at compile time. Thresholds and physics are the
// Model's.
//
//   kLeaves, kNodes, kGroups   what the pools hold
//   kMaxLevel                  of any leaf
//   kSubsteps                  at most, a tick
//   kPatches                   bisected, and merged, in a turn of the mesh (schedule.hpp); kTetsSplit and
//                              kTetsMerged tets in them
//   kRotationChanges           groups split or begun to be joined in a turn of the rotation front
//   kTethers                   nodes that are being released or drawn at a time
//   kContactCandidates         faces near the tool that a tick looks at closely
//   kStudyCriteria             whether criteria for studies are compiled in (remesh/rules.hpp)
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate {

/// The paper's bar (rho = 10 kg/m3) at level 6.
struct CuboidPaper {
  static constexpr const char* kName = "cuboid-paper";
  static constexpr uint16_t kLeaves = 1152;
  static constexpr uint16_t kNodes = 512;
  static constexpr uint16_t kGroups = 48;
  static constexpr uint8_t kMaxLevel = 6;
  static constexpr uint32_t kSubsteps = 3;
  static constexpr uint32_t kPatches = 1;
  static constexpr uint32_t kTetsSplit = 8;
  static constexpr uint32_t kTetsMerged = 8;
  static constexpr uint32_t kRotationChanges = 8;
  static constexpr uint16_t kTethers = 32;
  static constexpr uint32_t kContactCandidates = 64;
  static constexpr bool kStudyCriteria = false;
};

/// The same bar as heavy as tissue, with room for finer levels where it is touched.
struct CuboidDense {
  static constexpr const char* kName = "cuboid-dense";
  static constexpr uint16_t kLeaves = 1152;
  static constexpr uint16_t kNodes = 512;
  static constexpr uint16_t kGroups = 300;
  static constexpr uint8_t kMaxLevel = 9;
  static constexpr uint32_t kSubsteps = 1;
  static constexpr uint32_t kPatches = 4;
  static constexpr uint32_t kTetsSplit = 16;
  static constexpr uint32_t kTetsMerged = 16;
  static constexpr uint32_t kRotationChanges = 32;
  static constexpr uint16_t kTethers = 64;
  static constexpr uint32_t kContactCandidates = 64;
  static constexpr bool kStudyCriteria = false;
};

struct Organ {
  static constexpr const char* kName = "organ";
  static constexpr uint16_t kLeaves = 768;
  static constexpr uint16_t kNodes = 512;
  static constexpr uint16_t kGroups = 200;
  static constexpr uint8_t kMaxLevel = 9;
  static constexpr uint32_t kSubsteps = 1;
  static constexpr uint32_t kPatches = 2;
  static constexpr uint32_t kTetsSplit = 16;
  static constexpr uint32_t kTetsMerged = 16;
  static constexpr uint32_t kRotationChanges = 16;
  static constexpr uint16_t kTethers = 64;
  static constexpr uint32_t kContactCandidates = 64;
  static constexpr bool kStudyCriteria = false;
};

/// For the memory of a Cortex-M4, and bodies as heavy as tissue; within 1 ms of a Cortex-M7 at 480 MHz.
struct Small {
  static constexpr const char* kName = "small";
  static constexpr uint16_t kLeaves = 288;
  static constexpr uint16_t kNodes = 160;
  static constexpr uint16_t kGroups = 48;
  static constexpr uint8_t kMaxLevel = 6;
  static constexpr uint32_t kSubsteps = 1;
  static constexpr uint32_t kPatches = 1;
  static constexpr uint32_t kTetsSplit = 8;
  static constexpr uint32_t kTetsMerged = 8;
  static constexpr uint32_t kRotationChanges = 8;
  static constexpr uint16_t kTethers = 16;
  static constexpr uint32_t kContactCandidates = 24;
  static constexpr bool kStudyCriteria = false;
};

/// What a Cortex-M4 at 168 MHz is bound to compute within 1 ms.
struct Tiny {
  static constexpr const char* kName = "tiny";
  static constexpr uint16_t kLeaves = 96;
  static constexpr uint16_t kNodes = 48;
  static constexpr uint16_t kGroups = 22;
  static constexpr uint8_t kMaxLevel = 6;
  static constexpr uint32_t kSubsteps = 1;
  static constexpr uint32_t kPatches = 1;
  static constexpr uint32_t kTetsSplit = 8;
  static constexpr uint32_t kTetsMerged = 8;
  static constexpr uint32_t kRotationChanges = 4;
  static constexpr uint16_t kTethers = 8;
  static constexpr uint32_t kContactCandidates = 10;
  static constexpr bool kStudyCriteria = false;
};

/// Host only: deep or large meshes, and full corotation, for studies and tests.
struct Workstation {
  static constexpr const char* kName = "workstation";
  static constexpr uint16_t kLeaves = 12000;
  static constexpr uint16_t kNodes = 4000;
  static constexpr uint16_t kGroups = kLeaves;
  static constexpr uint8_t kMaxLevel = 14;
  static constexpr uint32_t kSubsteps = 8;
  static constexpr uint32_t kPatches = 16;
  static constexpr uint32_t kTetsSplit = 128;
  static constexpr uint32_t kTetsMerged = 128;
  static constexpr uint32_t kRotationChanges = 256;
  static constexpr uint16_t kTethers = 1000;
  static constexpr uint32_t kContactCandidates = 256;
  static constexpr bool kStudyCriteria = true;
};

}  // namespace palpate
