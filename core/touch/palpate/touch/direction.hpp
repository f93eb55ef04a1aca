// Directions, lengths and quotients of numbers whose size is not known beforehand: each is scaled to a full
// mantissa by its leading zeros, so no precision is lost at any size, and the division is reciprocal.hpp's.
#pragma once

#include "palpate/numeric/linear.hpp"
#include "palpate/numeric/reciprocal.hpp"

namespace palpate {

/// A part of a whole, 0 .. 1, and a component of a unit vector. LSB 2^-30.
using Fraction = Q<1, 30>;
using Direction = Vector3<Fraction>;

inline constexpr Fraction kFullFraction = Fraction::ratio(1, 1);

/// Number of zero bits above the highest set bit, 0 .. 63. x must not be 0.
constexpr int leading_zeros_of_64(uint64_t x) {
  const auto high = static_cast<uint32_t>(x >> 32);
  return high != 0 ? leading_zeros(high) : 32 + leading_zeros(static_cast<uint32_t>(x));
}

/// numerator / denominator within 0 .. 1; 0 for a numerator below 0 or a denominator of 0. Error 4 LSB.
inline Fraction fraction_of(int64_t numerator, int64_t denominator) {
  if (numerator <= 0 || denominator <= 0) return Fraction::from_raw(0);
  if (numerator >= denominator) return kFullFraction;
  const int room = leading_zeros_of_64(static_cast<uint64_t>(denominator)) - 1;
  const auto top = [room](int64_t x) {
    return Q<0, 31>::from_raw(static_cast<int32_t>(static_cast<uint64_t>(x) << room >> 32));
  };
  const auto quotient = narrow<Fraction>(top(numerator) * reciprocal_normalised(top(denominator)));
  return quotient > kFullFraction ? kFullFraction : quotient;
}

/// v / |v|, zero for a zero vector. The square of the raw numbers is below 2^63: 16 edges, 107
/// units of force. Error: 2 LSB
/// beyond v's own rounding. Cost: one reciprocal root and 6 multiplies.
template <class Scalar>
Direction direction_of(const Vector3<Scalar>& v) {
  const auto square = static_cast<uint64_t>(square_of(v).raw());
  if (square == 0) return zero_vector<Fraction>();
  // |v|^2 = m 2^(64 - room) in units of the LSB, m in [1/4, 1): 1 / |v| = y 2^(room / 2 - 32)
  const int room = leading_zeros_of_64(square) & ~1;
  const auto mantissa = Q<0, 31>::from_raw(static_cast<int32_t>(square << room >> 33));
  const Fraction y = reciprocal_square_root_normalised(mantissa);
  const int shift = 32 - room / 2;
  const auto along = [&](Eigen::Index axis) {
    const int64_t product = int64_t{v[axis].raw()} * y.raw();
    return Fraction::from_raw(static_cast<int32_t>(shift_right_rounded(product, shift)));
  };
  return Direction(along(0), along(1), along(2));
}

/// v . n of a unit vector: with n = v / |v| the length of v.
template <class Scalar>
Scalar component_along(const Vector3<Scalar>& v, const Direction& n) {
  return narrow<Scalar>(dot(v, n));
}

/// length n.
template <class Scalar>
Vector3<Scalar> vector_along(const Direction& n, Scalar length) {
  return Vector3<Scalar>(narrow<Scalar>(n[0] * length), narrow<Scalar>(n[1] * length),
                         narrow<Scalar>(n[2] * length));
}

/// fraction v.
template <class Scalar>
Vector3<Scalar> part_of(const Vector3<Scalar>& v, Fraction fraction) {
  return Vector3<Scalar>(narrow<Scalar>(v[0] * fraction), narrow<Scalar>(v[1] * fraction),
                         narrow<Scalar>(v[2] * fraction));
}

/// v, or a vector of its direction that is `most` long when v is longer (by 2 LSB more at most).
template <class Scalar>
Vector3<Scalar> limited_to(const Vector3<Scalar>& v, Scalar most) {
  if (square_of(v) <= most * most) return v;
  return vector_along(direction_of(v), most);
}

}  // namespace palpate
