// The frame in which the forces of a group are computed, and the ways into it and back. Its rotation is
// loaded from memory where it is needed: 13 registers do not hold it, and behind all loads of a node come all
// stores.
#pragma once

#include "palpate/elastic/leaf_force.hpp"
#include "palpate/mesh/rotation_front.hpp"
#include "palpate/numeric/opaque.hpp"

namespace palpate {

/// A rotation's entries below 1, so that a product's high word is its value.
using FrameEntry = Q<0, 31>;

/// Scratch of one evaluation: the frame of the group at hand, and positions and forces in it of the group's
/// nodes, in the order of its list. Beside each other, so that a node is one address.
template <class Profile>
struct GroupFrame {
  struct Node {
    Vector3<Position> position;
    Vector3<FrameForce> force;
  };
  Matrix3<FrameEntry> rotation;
  MeanGradient gradient;  // of its leaves
  std::array<Node, RotationFront<Profile>::kNodesOfGroup> node;
};

namespace group_frame_detail {

/// An entry of 1 becomes the largest one below it, which no ClampFlag may take for its own.
PALPATE_ALWAYS_INLINE void set_frame(const Quaternion& q, Matrix3<FrameEntry>& frame) {
  put_rotation_matrix(q, [&](Eigen::Index i, Eigen::Index j, RotationEntry entry) {
    frame(i, j) = FrameEntry::from_raw(2 * within_bits<31>(entry.raw()));
  });
}

/// Three variables, raw: a vector would lie on the stack.
struct Place {
  int32_t x, y, z;
};

/// R^T (x - origin), within +-4 edges so that no edge vector overflows; `twice` is 2 origin. Rounded once,
/// here and below: roundings in an order make a body swing that is pressed just so.
PALPATE_ALWAYS_INLINE Vector3<Position> into_frame(const Matrix3<FrameEntry>& r, const Vector3<Position>& x,
                                                   const Place& twice, ClampFlag& clamped) {
  using Doubled = Q<3, 28>;  // |x - origin| < 8
  const auto d0 = Doubled::from_raw(2 * x[0].raw() - twice.x);
  const auto d1 = Doubled::from_raw(2 * x[1].raw() - twice.y);
  const auto d2 = Doubled::from_raw(2 * x[2].raw() - twice.z);
  const auto along = [&](int axis) {
    return clamped.clamp<kPositionBits>(
        narrow<Position>(r(0, axis) * d0 + r(1, axis) * d1 + r(2, axis) * d2));
  };
  return Vector3<Position>(along(0), along(1), along(2));
}

/// R f.
PALPATE_ALWAYS_INLINE Vector3<Force> out_of_frame(const Matrix3<FrameEntry>& r,
                                                  const Vector3<FrameForce>& f) {
  const auto along = [&](int axis) {
    return narrow<Force>(r(axis, 0) * f[0] + r(axis, 1) * f[1] + r(axis, 2) * f[2]);
  };
  return Vector3<Force>(along(0), along(1), along(2));
}

}  // namespace group_frame_detail

}  // namespace palpate
