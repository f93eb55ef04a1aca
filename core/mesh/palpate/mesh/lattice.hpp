// Rest positions. Every node sits on an integer lattice with 32 steps to a cube edge, fine enough for the
// midpoints of level 14. The block of cubes is centred on the lattice origin.
#pragma once

#include "palpate/numeric/linear.hpp"

namespace palpate {

/// Position and displacement in cube edges: +-16, LSB 2^-27 edge (0.5 nm at 64 mm). Nodes stay within
/// kPositionLimit.
using Position = Q<4, 27>;

inline constexpr int kLatticeBits = 5;
inline constexpr int16_t kLatticeStepsPerEdge = 1 << kLatticeBits;
/// Deepest level of a leaf: 2^-14 of a root's volume, edges 1/32 of a cube's.
inline constexpr uint8_t kDeepestLevel = 14;

struct LatticePoint {
  int16_t x, y, z;
  friend constexpr bool operator==(LatticePoint a, LatticePoint b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  }
  friend constexpr bool operator!=(LatticePoint a, LatticePoint b) { return !(a == b); }
};

/// Exact for the ends of every refinement edge down to level kDeepestLevel - 1.
constexpr LatticePoint midpoint(LatticePoint a, LatticePoint b) {
  return LatticePoint{static_cast<int16_t>((a.x + b.x) / 2), static_cast<int16_t>((a.y + b.y) / 2),
                      static_cast<int16_t>((a.z + b.z) / 2)};
}

/// Rest position in cube edges, exact.
inline Vector3<Position> rest_position(LatticePoint p) {
  constexpr int32_t kScale = int32_t{1} << (Position::kFractionBits - kLatticeBits);
  return Vector3<Position>(Position::from_raw(p.x * kScale), Position::from_raw(p.y * kScale),
                           Position::from_raw(p.z * kScale));
}

/// A closed box of lattice points; empty when min > max on any axis.
struct LatticeBox {
  LatticePoint min, max;
  [[nodiscard]] constexpr bool contains(LatticePoint p) const {
    return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y && p.z >= min.z && p.z <= max.z;
  }
};

}  // namespace palpate
