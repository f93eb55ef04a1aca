// Whether a point is inside the organ: in any of its leaves, inverted ones included. For a tool that appears,
// which has no way that it came by.
#pragma once

#include "palpate/touch/sides.hpp"

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

/// `corner`: from the point to the nodes. The point divides the tet into four: it is inside when their
/// volumes have no two signs. Its surface is inside.
inline bool is_in_tet(const std::array<Offset, 4>& corner) {
  const int64_t v0 = volume(corner[1], corner[2], corner[3]);
  const int64_t v1 = -volume(corner[0], corner[2], corner[3]);
  const int64_t v2 = volume(corner[0], corner[1], corner[3]);
  const int64_t v3 = -volume(corner[0], corner[1], corner[2]);
  const bool has_below = (v0 | v1 | v2 | v3) < 0;
  const bool has_above = (-v0 | -v1 | -v2 | -v3) < 0;
  return !(has_below && has_above);
}

}  // namespace inside_detail

/// Leaves whose box holds a point: a few at rest. Where there are more, as in a heap of inverted leaves, the
/// answer is that it is inside.
inline constexpr uint32_t kMostBoxes = 16;

/// `x` within the position limit; `sides` is overwritten. Within 2^-16 edge of the surface either answer may
/// come. O(nodes + leaves), and kMostBoxes times four volumes of 9 products.
template <class Profile>
[[nodiscard]] bool is_inside(const Forest<Profile>& forest, const Vector3<Position>& x,
                             Sides<Profile>& sides) {
  namespace detail = inside_detail;
  sides.find(forest, x, Position::from_raw(0));
  std::array<uint32_t, kMostBoxes + 3> listed;
  const uint32_t count = list_leaves<kMostBoxes>(
      forest, listed, [&](const Leaf& leaf) { return sides.is_beyond(leaf) ? 0u : 1u; });
  if (count > kMostBoxes) return true;
  bool is_in = false;
  for (const uint32_t i : bounded<kMostBoxes>(count, [] {})) {
    const Leaf& leaf = forest.leaf[listed[i] / 16];
    const auto from_x = [&](uint32_t corner) {
      return detail::offset(x, forest.node.position[leaf.node[corner]]);
    };
    is_in = detail::is_in_tet({from_x(0), from_x(1), from_x(2), from_x(3)}) || is_in;
  }
  return is_in;
}

}  // namespace palpate
