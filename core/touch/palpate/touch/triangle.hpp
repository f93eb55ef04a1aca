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

inline uint64_t size_of(int64_t x) { return static_cast<uint64_t>(x < 0 ? -x : x); }

/// Brings numbers to one common scale, at which the largest of them has 30 bits and its sign. Rounded to
/// nearest.
class CommonScale {
 public:
  /// `all` sizes, by a bitwise or; below 2^63 and not 0.
  explicit CommonScale(uint64_t all) : room_(leading_zeros_of_64(all) - 1) {}
  [[nodiscard]] int32_t operator()(int64_t x) const {
    const auto high = static_cast<int32_t>(static_cast<uint64_t>(x) << room_ >> 32);
    return (high >> 1) + (high & 1);
  }

 private:
  int room_;
};

/// Products of the vectors above with one common scale, 30 bits and a sign each.
struct Products {
  int64_t e11, e12, e22, q1, q2;
};

inline Products scaled(const Vector3<Position>& e1, const Vector3<Position>& e2, const Vector3<Position>& q) {
  const Products p{square_of(e1).raw(), dot(e1, e2).raw(), square_of(e2).raw(), dot(q, e1).raw(),
                   dot(q, e2).raw()};
  const CommonScale scale(size_of(p.e11) | size_of(p.e12) | size_of(p.e22) | size_of(p.q1) | size_of(p.q2) |
                          1u);
  return Products{scale(p.e11), scale(p.e12), scale(p.e22), scale(p.q1), scale(p.q2)};
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
  const uint64_t all = triangle_detail::size_of(cross[0]) | triangle_detail::size_of(cross[1]) |
                       triangle_detail::size_of(cross[2]);
  if (all == 0) return zero_vector<Fraction>();
  const triangle_detail::CommonScale scale(all);
  return direction_of(Vector3<Position>(Position::from_raw(scale(cross[0])),
                                        Position::from_raw(scale(cross[1])),
                                        Position::from_raw(scale(cross[2]))));
}

}  // namespace palpate
