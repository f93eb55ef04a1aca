// The coarse shape of an organ: a block of up to 4 x 4 x 4 cubes, some absent, each with a material region.
#pragma once

#include "palpate/mesh/lattice.hpp"

namespace palpate {

inline constexpr uint32_t kMaxCubesPerAxis = 4;
inline constexpr uint32_t kMaxCubes = kMaxCubesPerAxis * kMaxCubesPerAxis * kMaxCubesPerAxis;
inline constexpr uint32_t kRootsPerCube = 6;
/// Material regions of one model.
inline constexpr uint32_t kRegions = 8;

struct Block {
  static constexpr uint8_t kAbsent = 0xff;

  uint8_t cubes[3];           // along x, y, z, 1 .. 4
  uint8_t region[kMaxCubes];  // of cube x + cubes[0] (y + cubes[1] z), or kAbsent

  [[nodiscard]] constexpr uint32_t cube_count() const {
    return static_cast<uint32_t>(cubes[0]) * cubes[1] * cubes[2];
  }
  /// Lattice point of the corner (i, j, k) of the cubes' grid; the block is centred on the origin.
  [[nodiscard]] constexpr LatticePoint corner(uint32_t i, uint32_t j, uint32_t k) const {
    return LatticePoint{along(i, cubes[0]), along(j, cubes[1]), along(k, cubes[2])};
  }

 private:
  static constexpr int16_t along(uint32_t at, uint32_t count) {
    return static_cast<int16_t>(static_cast<int32_t>(at) * kLatticeStepsPerEdge -
                                static_cast<int32_t>(count) * (kLatticeStepsPerEdge / 2));
  }
};

}  // namespace palpate
