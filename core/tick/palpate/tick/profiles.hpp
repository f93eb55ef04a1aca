// Profiles: all capacities of one build, fixed at compile time. Thresholds and physics are the Model's.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate {

/// The paper's bar (rho = 10 kg/m3) at level 6.
struct CuboidPaper {
  static constexpr const char* kName = "cuboid-paper";
  static constexpr uint16_t kLeaves = 1152;
  static constexpr uint16_t kNodes = 512;
  static constexpr uint16_t kGroups = kLeaves;  // full corotation: a rotation a leaf
  static constexpr uint8_t kMaxLevel = 6;
};

/// The same bar as heavy as tissue, with room for finer levels where it is touched.
struct CuboidDense {
  static constexpr const char* kName = "cuboid-dense";
  static constexpr uint16_t kLeaves = 1152;
  static constexpr uint16_t kNodes = 512;
  static constexpr uint16_t kGroups = kLeaves;
  static constexpr uint8_t kMaxLevel = 9;
};

struct Organ {
  static constexpr const char* kName = "organ";
  static constexpr uint16_t kLeaves = 768;
  static constexpr uint16_t kNodes = 512;
  static constexpr uint16_t kGroups = kLeaves;
  static constexpr uint8_t kMaxLevel = 9;
};

/// For a Cortex-M4.
struct Small {
  static constexpr const char* kName = "small";
  static constexpr uint16_t kLeaves = 288;
  static constexpr uint16_t kNodes = 160;
  static constexpr uint16_t kGroups = kLeaves;
  static constexpr uint8_t kMaxLevel = 6;
};

/// Host only: deep or large meshes for studies and tests.
struct Workstation {
  static constexpr const char* kName = "workstation";
  static constexpr uint16_t kLeaves = 12000;
  static constexpr uint16_t kNodes = 4000;
  static constexpr uint16_t kGroups = kLeaves;
  static constexpr uint8_t kMaxLevel = 14;
};

}  // namespace palpate
