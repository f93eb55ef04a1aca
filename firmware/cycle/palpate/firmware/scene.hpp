// Between the device's frame in metres and newtons and the body's in cube edges and E_ref edge^2.
#pragma once

#include "palpate/phantom/units.hpp"
#include "palpate/tick/model.hpp"

namespace palpate::firmware {

/// Cube edges a metre: edges of 16 mm and more.
using EdgesPerMetre = Q<6, 25>;

struct Scene {
  EdgesPerMetre edges_per_metre;
  // The device's origin in the body's frame, within +-4 edges. Not a Vector3: a scene must be a constant that
  // needs no code before main.
  std::array<Position, 3> device_origin;
  // Newtons on the handle for a force of E_ref edge^2: E_ref edge^2 times the force scale
  //   = newton_mantissa 2^newton_exponent, mantissa in [0.5, 1), exponent -16 .. 28
  Q<0, 31> newton_mantissa;
  int8_t newton_exponent;
};

/// Tool position in the body's frame; beyond +-8 edges of the device's origin it stays there.
inline Vector3<Position> in_body_frame(const Scene& scene, const Vector3<phantom::Metre>& device) {
  constexpr Position kReach = Position::ratio(8, 1);
  const auto along = [&](Eigen::Index axis) {
    const auto edges = narrow_saturated<Position>(device[axis] * scene.edges_per_metre);
    return clamp(edges, -kReach, kReach) + scene.device_origin[static_cast<std::size_t>(axis)];
  };
  return Vector3<Position>(along(0), along(1), along(2));
}

/// Force on the handle; beyond +-16 N a component saturates.
inline Vector3<phantom::Newton> on_handle(const Scene& scene, const Vector3<Force>& reaction) {
  using phantom::Newton;
  constexpr int kShift = Force::kFractionBits + 31 - Newton::kFractionBits;
  const auto along = [&](Eigen::Index axis) {
    const Acc<Force::kFractionBits + 31> product = reaction[axis] * scene.newton_mantissa;
    const int64_t rounded = shift_right_rounded(product.raw(), kShift - scene.newton_exponent);
    return narrow_saturated<Newton>(Acc<Newton::kFractionBits>::from_raw(rounded));
  };
  return Vector3<Newton>(along(0), along(1), along(2));
}

}  // namespace palpate::firmware
