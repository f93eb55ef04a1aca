// Whether a point is inside the organ: in any of its leaves, inverted ones included. For a tool that appears,
// which has no way that it came by.
#pragma once

#include "palpate/mesh/forest.hpp"

namespace palpate {
namespace inside_detail {

/// Differences of positions in 2^-16 edge (1 um at 64 mm): 2^19 at most, so that a volume fits 64 bits.
using Offset = std::array<int64_t, 3>;

inline Offset offset(const Vector3<Position>& from, const Vector3<Position>& to) {
  constexpr int kShift = Position::kFractionBits - 16;
  const auto along = [&](Eigen::Index axis) {
    return (int64_t{to[axis].raw()} - from[axis].raw()) >> kShift;
  };
  return {along(0), along(1), along(2)};
}

/// a . (b x c), below 2^60.
constexpr int64_t volume(const Offset& a, const Offset& b, const Offset& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Whether of each coordinate some corner has no more than x and some no less: by signs, without a branch.
inline bool is_in_box(const Vector3<Position>& a, const Vector3<Position>& b, const Vector3<Position>& c,
                      const Vector3<Position>& d, const Vector3<Position>& x) {
  const auto signs_along = [&](Eigen::Index axis) {
    const int32_t d0 = a[axis].raw() - x[axis].raw();
    const int32_t d1 = b[axis].raw() - x[axis].raw();
    const int32_t d2 = c[axis].raw() - x[axis].raw();
    const int32_t d3 = d[axis].raw() - x[axis].raw();
    return ((d0 - 1) | (d1 - 1) | (d2 - 1) | (d3 - 1)) & ~(d0 & d1 & d2 & d3);
  };
  return (signs_along(0) & signs_along(1) & signs_along(2)) < 0;
}

/// `corner`: from the point to the nodes. The point divides the tet into four: it is inside when their
/// volumes have no two signs. Its surface is inside.
inline bool is_in_tet(const std::array<Offset, 4>& corner) {
  const int64_t v0 = volume(corner[1], corner[2], corner[3]);
  const int64_t v1 = -volume(corner[0], corner[2], corner[3]);
  const int64_t v2 = volume(corner[0], corner[1], corner[3]);
  const int64_t v3 = -volume(corner[0], corner[1], corner[2]);
  const bool has_none_below = v0 >= 0 && v1 >= 0 && v2 >= 0 && v3 >= 0;
  const bool has_none_above = v0 <= 0 && v1 <= 0 && v2 <= 0 && v3 <= 0;
  return has_none_below || has_none_above;
}

}  // namespace inside_detail

/// Leaves whose box holds a point: a few at rest. Where there are more, as in a heap of inverted leaves, the
/// answer is that it is inside.
inline constexpr uint32_t kMostBoxes = 32;

/// `x` within the position limit. Within 2^-16 edge of the surface either answer may come. O(leaves): a box
/// each, and kMostBoxes times four volumes of 9 products.
template <class Profile>
[[nodiscard]] bool is_inside(const Forest<Profile>& forest, const Vector3<Position>& x) {
  namespace detail = inside_detail;
  bool is_in = false;
  auto boxes = bounded_total<kMostBoxes>([] {});
  for (const uint32_t i : bounded<Profile::kLeaves>(forest.leaf_count, [] {})) {
    const auto& node = forest.leaf[i].node;
    const Vector3<Position>& a = forest.node.position[node[0]];
    const Vector3<Position>& b = forest.node.position[node[1]];
    const Vector3<Position>& c = forest.node.position[node[2]];
    const Vector3<Position>& d = forest.node.position[node[3]];
    if (!detail::is_in_box(a, b, c, d, x)) continue;
    if (boxes.left() == 0) return true;
    for ([[maybe_unused]] const uint32_t box : boxes.take(0, 1)) {
      is_in = is_in || detail::is_in_tet({detail::offset(x, a), detail::offset(x, b), detail::offset(x, c),
                                          detail::offset(x, d)});
    }
  }
  return is_in;
}

}  // namespace palpate
