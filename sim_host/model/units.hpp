// Between doubles and the core's fixed-point formats. Host only.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "palpate/numeric/linear.hpp"

namespace palpate::sim {

inline constexpr double kTickS = 1e-3;
/// A degree.
inline constexpr double kRadians = 3.14159265358979323846 / 180.0;

template <int I, int F>
double to_double(Q<I, F> q) {
  return std::ldexp(static_cast<double>(q.raw()), -F);
}

/// Rounded to nearest; the caller has checked the range.
template <class To>
To to_fixed(double value) {
  return To::from_raw(static_cast<int32_t>(std::llround(std::ldexp(value, To::kFractionBits))));
}

/// For values below the format's end that may round up to it.
template <class To>
To to_fixed_below(double value) {
  const double raw = std::round(std::ldexp(value, To::kFractionBits));
  return To::from_raw(static_cast<int32_t>(std::min(raw, 2147483647.0)));
}

template <class Scalar>
std::array<double, 3> to_doubles(const Vector3<Scalar>& v) {
  return {to_double(v[0]), to_double(v[1]), to_double(v[2])};
}

}  // namespace palpate::sim
