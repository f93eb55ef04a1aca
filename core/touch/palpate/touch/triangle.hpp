// The closest point of a triangle and its normal, for triangles of any size and shape, flattened ones too.
//
// With e1 = b - a, e2 = c - a, q = p - a the foot of the perpendicular is a + v e1 + w e2,
//   v = (e2.e2 q.e1 - e1.e2 q.e2) / det,  w = (e1.e1 q.e2 - e1.e2 q.e1) / det,  det = e1.e1 e2.e2 - (e1.e2)^2
// (normal equations). If it is outside, the closest point is on an edge that it is outside of; of two such
// edges, which meet at a corner, on the one along which the foot is not beyond that corner, and there is one
// at most. If the angle at a is below 1/512 or near two right angles the triangle is its longest edge.
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

/// Of a number below 0 one less than its size. No branch.
inline uint64_t size_of(int64_t x) { return static_cast<uint64_t>(x ^ (x >> 63)); }

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
  int32_t e11, e12, e22, q1, q2;
};

PALPATE_ALWAYS_INLINE Products scaled(const Vector3<Position>& e1, const Vector3<Position>& e2,
                                      const Vector3<Position>& q) {
  const int64_t e11 = square_of(e1).raw();
  const int64_t e12 = dot(e1, e2).raw();
  const int64_t e22 = square_of(e2).raw();
  const int64_t q1 = dot(q, e1).raw();
  const int64_t q2 = dot(q, e2).raw();
  // e12 is no larger than the larger one of e11 and e22.
  const CommonScale scale(size_of(e11 | e22) | size_of(q1) | size_of(q2) | 1u);
  return Products{scale(e11), scale(e12), scale(e22), scale(q1), scale(q2)};
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

/// a b - c d.
constexpr int64_t determinant(int32_t a, int32_t b, int32_t c, int32_t d) {
  return int64_t{a} * b - int64_t{c} * d;
}

/// All ones for x <= 0, else 0.
constexpr int32_t if_not_above(int64_t x) { return static_cast<int32_t>(if_below(x - 1)); }

/// Which edge holds the closest point: one of the masks is all ones, the others 0.
struct Edge {
  int32_t ab, ac, bc;

  [[nodiscard]] int32_t choose(int32_t of_ab, int32_t of_ac, int32_t of_bc) const {
    return (of_ab & ab) | (of_ac & ac) | (of_bc & bc);
  }
};

/// A quarter, so that it is a word, of |bc|^2, and of |bc| times how far along bc the foot of p is.
struct AlongBc {
  int32_t square, foot;
};

inline AlongBc along_bc(const Products& s) {
  const int32_t corner = (s.e11 >> 2) - (s.e12 >> 2);
  return AlongBc{corner + (s.e22 >> 2) - (s.e12 >> 2), corner + (s.q2 >> 2) - (s.q1 >> 2)};
}

/// The weights v, w of b and c and u of a, times the determinant.
inline Edge edge_outside(const Products& s, const AlongBc& bc, int64_t v, int64_t w, int64_t u) {
  const int32_t beyond_ab = if_not_above(w);
  const int32_t beyond_ac = if_not_above(v);
  const int32_t beyond_bc = if_not_above(u);
  const int32_t is_ab = beyond_ab & ~(beyond_ac & if_below(-s.q2)) & ~(beyond_bc & if_below(-bc.foot));
  const int32_t is_bc = beyond_bc & ~is_ab & ~(beyond_ac & ~if_below(bc.foot - bc.square));
  return Edge{is_ab, ~(is_ab | is_bc), is_bc};
}

inline Edge longest_edge(const Products& s, const AlongBc& bc) {
  const int32_t is_ab = ~if_below(s.e11 - s.e22) & ~if_below((s.e11 >> 2) - bc.square);
  const int32_t is_ac = ~is_ab & ~if_below((s.e22 >> 2) - bc.square);
  return Edge{is_ab, is_ac, ~(is_ab | is_ac)};
}

}  // namespace triangle_detail

/// The point of triangle (a, b, c) closest to p; all within +-5 edges. Error: 4 LSB (2^-27 edge) in the
/// distance for triangles of more than 1/4096 edge and angles above 1/32; below an angle of 1/512 the
/// triangle's height at most. Cost: 23 products, one reciprocal, no loop.
inline TrianglePoint closest_on_triangle(const Vector3<Position>& a, const Vector3<Position>& b,
                                         const Vector3<Position>& c, const Vector3<Position>& p) {
  constexpr int kFlat = 18;
  const triangle_detail::Feet feet{a, b - a, c - a};
  const auto s = triangle_detail::scaled(feet.e1, feet.e2, p - a);

  const int64_t v = triangle_detail::determinant(s.e22, s.q1, s.e12, s.q2);
  const int64_t w = triangle_detail::determinant(s.e11, s.q2, s.e12, s.q1);
  const int64_t det = triangle_detail::determinant(s.e11, s.e22, s.e12, s.e12);
  const int64_t u = det - v - w;
  const int32_t flat = triangle_detail::if_not_above(det - (int64_t{s.e11} * s.e22 >> kFlat));
  const int32_t outside =
      triangle_detail::if_not_above(v) | triangle_detail::if_not_above(w) | triangle_detail::if_not_above(u);
  if ((outside | flat) == 0) {
    const PartsOf<int64_t> whole(det);
    const Fraction part = whole(v);
    const Fraction other = whole(w);
    return feet.at(part, other > kFullFraction - part ? kFullFraction - part : other, true);
  }

  const triangle_detail::AlongBc bc = triangle_detail::along_bc(s);
  const triangle_detail::Edge of_plane = triangle_detail::edge_outside(s, bc, v, w, u);
  const triangle_detail::Edge of_line = triangle_detail::longest_edge(s, bc);
  const auto choose = [flat](int32_t if_plane, int32_t if_line) {
    return (if_plane & ~flat) | (if_line & flat);
  };
  const triangle_detail::Edge edge{choose(of_plane.ab, of_line.ab), choose(of_plane.ac, of_line.ac),
                                   choose(of_plane.bc, of_line.bc)};
  const int32_t along =
      fraction_of(edge.choose(s.q1, s.q2, bc.foot), edge.choose(s.e11, s.e22, bc.square)).raw();
  return feet.at(Fraction::from_raw(edge.choose(along, 0, kFullFraction.raw() - along)),
                 Fraction::from_raw(along & ~edge.ab), false);
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
