// Between the device's frame in metres and newtons and the body's in cube edges and E_ref edge^2:
//   x_body = R x_device (s / edge) + origin      s: motion scale, way of the tool over way of the handle
//   F_device = R^T F_body (g E_ref edge^2)       g: force scale, force on the handle over force of the tissue
// In SI, F_device . dx_device = (g / s) F_body . dx_body: the hand's work is the tool's times a constant. So
// a tool that is passive (palpate/touch/passivity.hpp, in the body's frame, before this mapping) is passive
// at the handle too, as long as nothing is cut: at 16 N a component here, or by the safety layer.
#pragma once

#include "palpate/phantom/units.hpp"
#include "palpate/tick/model.hpp"

namespace palpate::firmware {

/// Of the body for a metre of the handle: s / edge, with edges of 16 mm and more for s = 1.
using EdgesPerMetre = Q<6, 25>;
/// s >= 0.1 at edges of 128 mm, and s = 1 at edges of 16 mm.
inline constexpr EdgesPerMetre kLeastEdgesPerMetre = EdgesPerMetre::ratio(100, 128);
inline constexpr EdgesPerMetre kMostEdgesPerMetre = EdgesPerMetre::ratio(1000, 16);

/// R by rows, each entry within +-1. Not a Matrix3: see device_origin.
using DeviceRotation = std::array<RotationEntry, 9>;
inline constexpr RotationEntry kWholeEntry = RotationEntry::ratio(1, 1);
inline constexpr RotationEntry kZeroEntry = RotationEntry::from_raw(0);
/// The device's axes are the body's. Exact: what is turned by it keeps its bits.
inline constexpr DeviceRotation kNotTurned = {kWholeEntry, kZeroEntry, kZeroEntry, kZeroEntry, kWholeEntry,
                                              kZeroEntry,  kZeroEntry, kZeroEntry, kWholeEntry};

/// Every member has to be given: a rotation of zeros is none.
struct Scene {
  EdgesPerMetre edges_per_metre;
  // The device's origin in the body's frame, within +-4 edges. Not a Vector3: a scene must be a constant that
  // needs no code before main.
  std::array<Position, 3> device_origin;
  DeviceRotation device_rotation;
  // Newtons on the handle for a force of E_ref edge^2: E_ref edge^2 times the force scale
  //   = newton_mantissa 2^newton_exponent, mantissa in [0.5, 1), exponent -16 .. 28
  Q<0, 31> newton_mantissa;
  int8_t newton_exponent;
};

namespace scene_detail {

/// Sum of three products, each entry within +-1. Saturates. A call: inlined
/// six times it is 370 bytes more.
template <class Scalar>
PALPATE_NOINLINE Scalar weighed(const Vector3<Scalar>& v, RotationEntry x, RotationEntry y, RotationEntry z) {
  return narrow_saturated<Scalar>(v[0] * x + v[1] * y + v[2] * z);
}

}  // namespace scene_detail

/// R v. Error: 1.5 LSB of v beyond R's own 2^-31 an entry. Cost: 9 multiplies.
template <class Scalar>
Vector3<Scalar> to_body_axes(const DeviceRotation& r, const Vector3<Scalar>& v) {
  using scene_detail::weighed;
  return Vector3<Scalar>(weighed(v, r[0], r[1], r[2]), weighed(v, r[3], r[4], r[5]),
                         weighed(v, r[6], r[7], r[8]));
}

/// R^T v, as to_body_axes.
template <class Scalar>
Vector3<Scalar> to_device_axes(const DeviceRotation& r, const Vector3<Scalar>& v) {
  using scene_detail::weighed;
  return Vector3<Scalar>(weighed(v, r[0], r[3], r[6]), weighed(v, r[1], r[4], r[7]),
                         weighed(v, r[2], r[5], r[8]));
}

/// Tool position in the body's frame; beyond +-8 edges of the device's origin, or 1 m of it along one of the
/// body's axes, it stays there. Within 8 LSB (2^-24 edge) of the exact one. Cost: 12 multiplies.
inline Vector3<Position> in_body_frame(const Scene& scene, const Vector3<phantom::Metre>& device) {
  constexpr Position kReach = Position::ratio(8, 1);
  const Vector3<phantom::Metre> turned = to_body_axes(scene.device_rotation, device);
  const auto along = [&](Eigen::Index axis) {
    const auto edges = narrow_saturated<Position>(turned[axis] * scene.edges_per_metre);
    return clamp(edges, -kReach, kReach) + scene.device_origin[static_cast<std::size_t>(axis)];
  };
  return Vector3<Position>(along(0), along(1), along(2));
}

/// Force on the handle; beyond +-16 N a component saturates. Cost: 12 multiplies.
inline Vector3<phantom::Newton> on_handle(const Scene& scene, const Vector3<Force>& reaction) {
  using phantom::Newton;
  constexpr int kShift = Force::kFractionBits + 31 - Newton::kFractionBits;
  const Vector3<Force> turned = to_device_axes(scene.device_rotation, reaction);
  const auto along = [&](Eigen::Index axis) {
    const Acc<Force::kFractionBits + 31> product = turned[axis] * scene.newton_mantissa;
    const int64_t rounded = shift_right_rounded(product.raw(), kShift - scene.newton_exponent);
    return narrow_saturated<Newton>(Acc<Newton::kFractionBits>::from_raw(rounded));
  };
  return Vector3<Newton>(along(0), along(1), along(2));
}

}  // namespace palpate::firmware
