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

/// Number of zero bits above the highest set bit, 0 .. 63. x must not be 0. No branch.
constexpr int leading_zeros_of_64(uint64_t x) {
  const auto high = static_cast<uint32_t>(x >> 32);
  const uint32_t is_low = high == 0 ? 1 : 0;
  return leading_zeros(high | (static_cast<uint32_t>(x) & (0u - is_low))) + static_cast<int>(32u * is_low);
}

/// All ones for a number below 0, else 0.
template <class Integer>
constexpr Integer if_below(Integer x) {
  return static_cast<Integer>(x >> (8 * static_cast<int>(sizeof(Integer)) - 1));
}
/// x, or 0 for less. No branch. On a Cortex-M it sets the sticky flag: not while a ClampFlag is in use.
template <class Integer>
PALPATE_ALWAYS_INLINE Integer not_below_zero(Integer x) {
#ifdef PALPATE_TARGET
  if constexpr (std::is_same_v<Integer, int32_t>) {
    int32_t at_least_zero;
    asm("usat %0, #31, %1" : "=r"(at_least_zero) : "r"(x));
    return at_least_zero;
  }
#endif
  return x & ~if_below(x);
}

/// Parts of one whole, a number of 32 or 64 bits above 0: a reciprocal, and a multiply for each of them.
template <class Integer>
class PartsOf {
 public:
  explicit PartsOf(Integer whole)
      : room_(room_above(whole)), reciprocal_(reciprocal_normalised(top(whole))) {}
  /// part / whole of 0 <= part <= whole, at most 1. Error 4 LSB.
  [[nodiscard]] Fraction operator()(Integer part) const {
    const int32_t above = (narrow<Fraction>(top(part) * reciprocal_) - kFullFraction).raw();
    return kFullFraction + Fraction::from_raw(above & if_below(above));
  }

 private:
  static constexpr bool kIsLong = sizeof(Integer) == 8;

  static int room_above(Integer whole) {
    if constexpr (kIsLong) {
      return leading_zeros_of_64(static_cast<uint64_t>(whole)) - 1;
    } else {
      return leading_zeros(static_cast<uint32_t>(whole)) - 1;
    }
  }
  [[nodiscard]] Q<0, 31> top(Integer x) const {
    const auto shifted = static_cast<std::make_unsigned_t<Integer>>(x) << room_;
    if constexpr (kIsLong) {
      return Q<0, 31>::from_raw(static_cast<int32_t>(shifted >> 32));
    } else {
      return Q<0, 31>::from_raw(static_cast<int32_t>(shifted));
    }
  }
  int room_;
  Fraction reciprocal_;
};

/// numerator / denominator within 0 .. 1, exactly 1 for a numerator that is not less; 0 for a numerator below
/// 0 or a denominator of 0. Both are less than half of what they hold. Error 4 LSB. No branch.
template <class Integer>
Fraction fraction_of(Integer numerator, Integer denominator) {
  const Integer whole = 1 + not_below_zero(denominator - 1);
  const Integer part = not_below_zero(numerator) & ~if_below(denominator - 1);
  const Integer missing = not_below_zero(whole - part);
  const int32_t less = (PartsOf<Integer>(whole)(whole - missing) - kFullFraction).raw();
  return kFullFraction + Fraction::from_raw(less & static_cast<int32_t>(if_below(-missing)));
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
  // The upper word of the product 2^(room / 2), rounded.
  const auto along = [&](Eigen::Index axis) {
    const auto product = static_cast<uint64_t>(int64_t{v[axis].raw()} * y.raw()) << (room / 2);
    return Fraction::from_raw(static_cast<int32_t>((product + (uint64_t{1} << 31)) >> 32));
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
