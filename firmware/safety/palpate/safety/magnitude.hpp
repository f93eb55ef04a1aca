// Lengths of vectors, compared by their squares: no root and no rounding.
#pragma once

#include "palpate/numeric/linear.hpp"

namespace palpate::safety {

/// (value / LSB)^2, at most 2^62.
template <int I, int F>
constexpr uint64_t square(Q<I, F> value) {
  return static_cast<uint64_t>((value * value).raw());
}

/// |v|^2 in LSB^2; three squares of at most 2^62 fit in 64 bits. 3 multiplies.
template <int I, int F>
uint64_t square_norm(const Vector3<Q<I, F>>& v) {
  return square(v.x()) + square(v.y()) + square(v.z());
}

/// a - b; a component beyond the format becomes its end.
template <int I, int F>
Vector3<Q<I, F>> saturated_difference(const Vector3<Q<I, F>>& a, const Vector3<Q<I, F>>& b) {
  using Scalar = Q<I, F>;
  const auto along = [&](Eigen::Index axis) {
    return narrow_saturated<Scalar>(widen<F>(a[axis]) - widen<F>(b[axis]));
  };
  return Vector3<Scalar>(along(0), along(1), along(2));
}

}  // namespace palpate::safety
