// Rotations: a unit quaternion to keep and to compose, a matrix to apply.
#pragma once

#include "palpate/numeric/high_word.hpp"
#include "palpate/numeric/linear.hpp"
#include "palpate/numeric/reciprocal.hpp"

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

inline Acc<60> dot(const Quaternion& a, const Quaternion& b) {
  return a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
}

/// `put(i, j, R_ij)` for each entry of R of a unit quaternion, columns = images of the axes. Error: 1 LSB a
/// entry beyond the quaternion's own.
template <class Put>
PALPATE_ALWAYS_INLINE void put_rotation_matrix(const Quaternion& q, Put put) {
  const RotationEntry w = q.w, x = q.x, y = q.y, z = q.z;  // not a copy of q, which would lie on the stack
  const auto twice = [](Acc<60> acc) { return narrow<RotationEntry>(Acc<59>::from_raw(acc.raw())); };
  const auto pair = [&](Eigen::Index i, Eigen::Index j, Acc<60> even, Acc<60> odd) {
    put(i, j, twice(even - odd));
    put(j, i, twice(even + odd));
  };
  pair(0, 1, x * y, w * z);
  pair(2, 0, x * z, w * y);
  pair(1, 2, y * z, w * x);
  const auto half = widen<60>(RotationEntry::ratio(1, 2));
  const auto xx = x * x;
  const auto yy = y * y;
  const auto zz = z * z;
  put(0, 0, twice(half - yy - zz));
  put(1, 1, twice(half - xx - zz));
  put(2, 2, twice(half - xx - yy));
}

/// All nine entries of R.
void rotation_matrix(const Quaternion& q, RotationMatrix& r);
inline RotationMatrix rotation_matrix(const Quaternion& q) {
  RotationMatrix r;
  rotation_matrix(q, r);
  return r;
}

/// q becomes q / |q|, for |q|^2 in [0.5, 2), or below by a rounding, as halfway between rotations half a turn
/// apart. Error: 1 LSB. Cost: one reciprocal root and 8 multiplies.
PALPATE_ALWAYS_INLINE void normalise(Quaternion& q) {
  const auto more = reciprocal_square_root_less_one(narrow<Q<1, 30>>(dot(q, q)));
  q = Quaternion{multiply_add_high(q.w, more, q.w), multiply_add_high(q.x, more, q.x),
                 multiply_add_high(q.y, more, q.y), multiply_add_high(q.z, more, q.z)};
}

/// q goes `fraction` (0 .. 1) of the way to another rotation, the short way: q + fraction (to - q),
/// normalised. With 1 it becomes `to` (or -to, the same rotation) exactly.
void approach(Quaternion& q, const Quaternion& to, RotationEntry fraction);

/// 4 (1 - cos theta) of two rotations an angle theta apart, which is |R_a - R_b|_F^2 (Tagawa et al., Eq. 3):
/// 8 |v|^2 with v the vector part of conj(a) b. Error: 4 LSB of 2^-27.
Q<4, 27> square_of_difference(const Quaternion& a, const Quaternion& b);

}  // namespace palpate
