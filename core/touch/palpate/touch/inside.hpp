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

inline bool is_in_box(const std::array<Offset, 4>& corner) {
  bool is_in = true;
  for (const uint32_t axis : bounded<3>(3, [] {})) {
    const bool is_below =
        corner[0][axis] <= 0 || corner[1][axis] <= 0 || corner[2][axis] <= 0 || corner[3][axis] <= 0;
    const bool is_above =
        corner[0][axis] >= 0 || corner[1][axis] >= 0 || corner[2][axis] >= 0 || corner[3][axis] >= 0;
    is_in = is_in && is_below && is_above;
  }
  return is_in;
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

/// `x` within the position limit. Within 2^-16 edge of the surface either answer may come. O(leaves): a box
/// each, and four volumes of 9 products where the box holds x.
template <class Profile>
[[nodiscard]] bool is_inside(const Forest<Profile>& forest, const Vector3<Position>& x) {
  namespace detail = inside_detail;
  bool is_in = false;
  for (const uint32_t i : bounded<Profile::kLeaves>(forest.leaf_count, [] {})) {
    const auto& node = forest.leaf[i].node;
    const auto& position = forest.node.position;
    const std::array<detail::Offset, 4> corner = {
        detail::offset(x, position[node[0]]), detail::offset(x, position[node[1]]),
        detail::offset(x, position[node[2]]), detail::offset(x, position[node[3]])};
    if (detail::is_in_box(corner) && detail::is_in_tet(corner)) is_in = true;
  }
  return is_in;
}

}  // namespace palpate
