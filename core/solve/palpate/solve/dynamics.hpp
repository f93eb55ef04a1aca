// What the integrator needs to know of a model, in substeps and cube edges.
#pragma once

#include "palpate/mesh/node_state.hpp"
#include "palpate/numeric/reciprocal.hpp"
#include "palpate/numeric/rotation.hpp"

namespace palpate {

/// Displacement a substep and substep, for one unit of force: dt^2 E_ref edge / m. 0 .. 8, LSB 2^-28.
using Impulse = Q<3, 28>;

inline constexpr uint32_t kMaxSubsteps = 8;

struct Dynamics {
  uint8_t substeps;            // a tick, 1 .. kMaxSubsteps
  Q<-5, 36> mass_damping;      // alpha_M dt
  Q<0, 31> stiffness_damping;  // beta_K / dt
  // K = impulse x MassUnits = impulse_mantissa 2^impulse_exponent, mantissa in [0.5, 1)
  Q<0, 31> impulse_mantissa;
  int8_t impulse_exponent;
};

/// Impulse of a node with this lumped mass (> 0). Relative error 2^-28.
inline Impulse impulse_of(const Dynamics& dynamics, MassUnits mass) {
  const int room = leading_zeros(mass);
  const auto mantissa = Q<0, 31>::from_raw(static_cast<int32_t>((mass << room) >> 1));
  const Acc<61> quotient = dynamics.impulse_mantissa * reciprocal_normalised(mantissa);
  const int exponent = dynamics.impulse_exponent - (32 - room);
  constexpr int kWholeShift = 61 - Impulse::kFractionBits;
  return Impulse::from_raw(static_cast<int32_t>(shift_right_rounded(quotient.raw(), kWholeShift - exponent)));
}

/// A rigid motion in the body's frame: x = rotation x0 + translation, translation within +-8 edges.
struct RigidMotion {
  RotationMatrix rotation;
  Vector3<Position> translation;

  static RigidMotion identity() {
    return RigidMotion{rotation_matrix(Quaternion::identity()), zero_vector<Position>()};
  }
  /// Of a node's place on the lattice, within +-2 edges. Rounded once.
  [[nodiscard]] Vector3<Position> operator()(LatticePoint x0) const {
    using Edges = Q<2, 29>;  // so that a product's high word is a position
    const auto edges = [](int32_t steps) {
      return Edges::from_raw(steps * (1 << (Edges::kFractionBits - kLatticeBits)));
    };
    const Edges x = edges(x0.x), y = edges(x0.y), z = edges(x0.z);
    const auto along = [&](Eigen::Index axis) {
      return narrow<Position>(rotation(axis, 0) * x + rotation(axis, 1) * y + rotation(axis, 2) * z) +
             translation[axis];
    };
    return Vector3<Position>(along(0), along(1), along(2));
  }
};

}  // namespace palpate
