// What every node carries: the plain type through which the mesh, elasticity, the solver and touch share a
// body.
#pragma once

#include "palpate/mesh/lattice.hpp"
#include "palpate/numeric/clamp_flag.hpp"

namespace palpate {

/// Cube edges a substep: +-1/32, LSB 2^-36 edge (2^-40 m at 64 mm).
using Velocity = Q<-5, 36>;
/// Elastic force in E_ref edge^2: +-64, LSB 2^-25 (6e-8 N for 500 Pa and 64 mm).
using Force = Q<6, 25>;

/// Coordinates, also those at which forces are evaluated, stay in [-4, 4) edges, so no edge vector of the
/// three shapes leaves Position.
inline constexpr int kPositionBits = Position::kFractionBits + 3;
inline constexpr Position kPositionLimit = Position::from_raw((int32_t{1} << (kPositionBits - 1)) - 1);

inline Vector3<Position> within_position_limit(const Vector3<Position>& x) {
  const auto within = [](Position along) {
    return Position::from_raw(within_bits<kPositionBits>(along.raw()));
  };
  return Vector3<Position>(within(x[0]), within(x[1]), within(x[2]));
}

/// One unit is a quarter of the volume of a level-15 tet at the density ratio 1/kDensityOne.
using MassUnits = uint32_t;
inline constexpr int kMassLevels = 15;
inline constexpr uint32_t kDensityOne = 2048;

/// Lumped mass that a tet of this level gives to each of its nodes. At most 48 tets meet at a node, and the
/// sum stays below 2^32 for kDensityOne at every level.
constexpr MassUnits quarter_mass(uint8_t level, uint16_t density) {
  return static_cast<MassUnits>(density) << (kMassLevels - level);
}

template <uint16_t Capacity>
struct NodeState {
  std::array<LatticePoint, Capacity> rest;
  std::array<MassUnits, Capacity> mass;
  std::array<Vector3<Position>, Capacity> position;
  std::array<Vector3<Velocity>, Capacity> velocity;
  std::array<Vector3<Force>, Capacity> force;
};

}  // namespace palpate
