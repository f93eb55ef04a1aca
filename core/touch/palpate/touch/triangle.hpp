// The closest point of a triangle and its normal, for triangles of any size and shape, flattened ones too.
//
// With e1 = b - a, e2 = c - a, q = p - a the foot of the perpendicular is a + v e1 + w e2,
//   v = (e2.e2 q.e1 - e1.e2 q.e2) / det,  w = (e1.e1 q.e2 - e1.e2 q.e1) / det,  det = e1.e1 e2.e2 - (e1.e2)^2
// (normal equations). If it is outside, or the angle at a is below 1/512, the closest point is on an edge,
// and the closest of the three edges' is taken.
#pragma once

#include "palpate/mesh/lattice.hpp"
#include "palpate/touch/direction.hpp"

namespace palpate {

/// Weights of a point of a triangle: each 0 .. 1, and together exactly 1.
using Weights = std::array<Fraction, 3>;

struct TrianglePoint {
  Weights weight;
  Vector3<Position> point;
  bool is_inner;  // all weights above 0: p is straight above or below it
};

namespace triangle_detail {

/// Products of the vectors above with one common scale, 30 bits and a sign each.
struct Products {
  int64_t e11, e12, e22, q1, q2;
};

inline Products scaled(const Vector3<Position>& e1, const Vector3<Position>& e2, const Vector3<Position>& q) {
  const Products p{square_of(e1).raw(), dot(e1, e2).raw(), square_of(e2).raw(), dot(q, e1).raw(),
                   dot(q, e2).raw()};
  const auto size = [](int64_t x) { return static_cast<uint64_t>(x < 0 ? -x : x); };
  const uint64_t all = size(p.e11) | size(p.e12) | size(p.e22) | size(p.q1) | size(p.q2) | 1u;
  const int used = 64 - leading_zeros_of_64(all);
  const int shift = used > 30 ? used - 30 : 0;
  const auto down = [shift](int64_t x) { return shift_right_rounded(x, shift); };
  return Products{down(p.e11), down(p.e12), down(p.e22), down(p.q1), down(p.q2)};
}

struct Feet {
  Vector3<Position> origin, e1, e2;

  [[nodiscard]] TrianglePoint at(Fraction v, Fraction w, bool is_inner) const {
    const Vector3<Position> step(narrow<Position>(e1[0] * v + e2[0] * w),
                                 narrow<Position>(e1[1] * v + e2[1] * w),
                                 narrow<Position>(e1[2] * v + e2[2] * w));
    return TrianglePoint{Weights{kFullFraction - v - w, v, w}, origin + step, is_inner};
  }
};

}  // namespace triangle_detail

/// The point of triangle (a, b, c) closest to p; all within +-5 edges. Error: 4 LSB (2^-27 edge) in the
/// distance for triangles of more than 1/4096 edge and angles above 1/32; below an angle of 1/512 the
/// triangle's height at most. Cost: 23 products, 5 quotients, no loop.
inline TrianglePoint closest_on_triangle(const Vector3<Position>& a, const Vector3<Position>& b,
                                         const Vector3<Position>& c, const Vector3<Position>& p) {
  constexpr int kFlat = 18;
  const triangle_detail::Feet feet{a, b - a, c - a};
  const auto s = triangle_detail::scaled(feet.e1, feet.e2, p - a);
  const Fraction zero = Fraction::from_raw(0);

  const int64_t det = s.e11 * s.e22 - s.e12 * s.e12;
  const int64_t v = s.e22 * s.q1 - s.e12 * s.q2;
  const int64_t w = s.e11 * s.q2 - s.e12 * s.q1;
  if (v > 0 && w > 0 && v + w < det && det > (s.e11 * s.e22) >> kFlat) {
    const Fraction part = fraction_of(v, det);
    const Fraction other = fraction_of(w, det);
    return feet.at(part, other > kFullFraction - part ? kFullFraction - part : other, true);
  }

  const Fraction along_bc = fraction_of(s.q2 - s.q1 + s.e11 - s.e12, s.e11 + s.e22 - s.e12 - s.e12);
  TrianglePoint nearest = feet.at(fraction_of(s.q1, s.e11), zero, false);
  auto least = square_of(Vector3<Position>(p - nearest.point));
  const auto offer = [&](const TrianglePoint& other) {
    const auto square = square_of(Vector3<Position>(p - other.point));
    if (square >= least) return;
    least = square;
    nearest = other;
  };
  offer(feet.at(zero, fraction_of(s.q2, s.e22), false));
  offer(feet.at(kFullFraction - along_bc, along_bc, false));
  return nearest;
}

/// Unit normal of triangle (a, b, c), from where it is seen counterclockwise; zero if it has no area at all.
/// Its error is that of the vertices' rounding, 2^-26 over the triangle's height.
inline Direction triangle_normal(const Vector3<Position>& a, const Vector3<Position>& b,
                                 const Vector3<Position>& c) {
  const Vector3<Position> e1 = b - a;
  const Vector3<Position> e2 = c - a;
  const std::array<int64_t, 3> cross = {(e1[1] * e2[2] - e1[2] * e2[1]).raw(),
                                        (e1[2] * e2[0] - e1[0] * e2[2]).raw(),
                                        (e1[0] * e2[1] - e1[1] * e2[0]).raw()};
  const auto size = [](int64_t x) { return static_cast<uint64_t>(x < 0 ? -x : x); };
  const uint64_t all = size(cross[0]) | size(cross[1]) | size(cross[2]);
  if (all == 0) return zero_vector<Fraction>();
  const int used = 64 - leading_zeros_of_64(all);
  const int shift = used > 30 ? used - 30 : 0;
  const auto down = [&](std::size_t axis) {
    return Position::from_raw(static_cast<int32_t>(shift_right_rounded(cross[axis], shift)));
  };
  return direction_of(Vector3<Position>(down(0), down(1), down(2)));
}

}  // namespace palpate
