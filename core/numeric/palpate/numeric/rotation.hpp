// Rotations: a unit quaternion to keep and to compose, a matrix to apply.
#pragma once

#include "palpate/numeric/linear.hpp"

namespace palpate {

/// Entries of a rotation matrix and of a unit quaternion: LSB 2^-30.
using RotationEntry = Q<1, 30>;
using RotationMatrix = Matrix3<RotationEntry>;

struct Quaternion {
  RotationEntry w, x, y, z;
  static constexpr Quaternion identity() {
    const RotationEntry zero = RotationEntry::from_raw(0);
    return Quaternion{RotationEntry::ratio(1, 1), zero, zero, zero};
  }
};

/// R of a unit quaternion, columns = images of the axes. Error: 1 LSB a entry beyond the quaternion's own.
RotationMatrix rotation_matrix(const Quaternion& q);

}  // namespace palpate
