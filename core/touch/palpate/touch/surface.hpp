// The surface of the organ: the faces of leaves without a neighbour. Where it is near a point is found anew
// in every tick, so nothing has to survive a change of the mesh: a face that is split or merged is seen as it
// is in the same tick, and a tool that arrives, however fast, is seen in the tick in which it is within the
// range.
//
//   find_candidates   one look at all nodes and leaves; keeps the faces whose box is near the tool, at most
//                     Profile::kContactCandidates of them (candidates.hpp)
//   nearest_surface   the closest point on the candidates, exactly
//
// When more faces are in range than there is room for, the range shrinks until the nearest ones fit; `range`
// is what it ended at, and every face of the surface within it is among the candidates.
#pragma once

#include "palpate/touch/candidates.hpp"
#include "palpate/touch/triangle.hpp"

namespace palpate {

/// Nodes of a face, counterclockwise as seen from outside.
using FaceNodes = std::array<uint16_t, 3>;

/// 1 when g1, g2, g3 of a leaf are a left-handed system at rest, else 0. No branch.
inline uint32_t is_mirrored(Axes axes) {
  constexpr uint32_t kEven = 1u << (0 + 4 * 1) | 1u << (1 + 4 * 2) | 1u << (2 + 4 * 0);
  const uint32_t is_even = kEven >> (axes.axis(0) + 4 * axes.axis(1));
  const auto sign = [axes](uint32_t k) { return axes.is_negative(k) ? 1u : 0u; };
  return (~is_even ^ sign(0) ^ sign(1) ^ sign(2)) & 1u;
}

/// The face opposite w_face. What is outside follows from the rest shape, so a tet that is inside out does
/// not turn it. No branch.
inline FaceNodes face_nodes(const Leaf& leaf, uint32_t face) {
  // Of each face the places in the leaf, two bits each from the lowest: 1 2 3, 0 3 2, 0 1 3, 0 2 1.
  constexpr uint32_t kPlaces = 0x39u | 0x2cu << 8 | 0x34u << 16 | 0x18u << 24;
  const uint32_t places = kPlaces >> (8 * face);
  const uint32_t second = places >> 2 & 3u;
  const uint32_t third = places >> 4 & 3u;
  const uint32_t swapped = (second ^ third) & (0u - is_mirrored(leaf.axes()));
  return FaceNodes{leaf.node[places & 3u], leaf.node[second ^ swapped], leaf.node[third ^ swapped]};
}

template <class Profile>
[[nodiscard]] FaceNodes nodes_of(const Forest<Profile>& forest, const Candidate& candidate) {
  return face_nodes(forest.leaf[candidate.face >> 2], candidate.face & 3u);
}

namespace surface_detail {

/// How many candidates may be as near as `within`: those whose places are listed.
template <class Profile>
uint32_t list_within(Position within, Candidates<Profile>& candidates) {
  uint32_t count = 0;
  const auto is_near = [&](uint32_t i) {
    return static_cast<uint32_t>(1 + if_below((within - candidates.face[i].bound).raw()));
  };
  const auto list = [&](uint32_t i, uint32_t one) {
    candidates.listed[count] = i;
    count += one;
  };
  for (const uint32_t pair : bounded<Candidates<Profile>::kMost / 2>(candidates.count / 2, [] {})) {
    uint32_t one0 = is_near(2 * pair);
    uint32_t one1 = is_near(2 * pair + 1);
    have_both(one0, one1);
    list(2 * pair, one0);
    list(2 * pair + 1, one1);
  }
  if (candidates.count % 2 != 0) list(candidates.count - 1, is_near(candidates.count - 1));
  return count;
}

}  // namespace surface_detail

struct SurfacePoint {
  FaceNodes node;
  Weights weight;
  Vector3<Position> point;
  Direction normal;   // from the surface to x outside of it; zero where that is not known
  Position distance;  // of x, negative inside
};

/// The point closest to x, of the candidates that may be as near as `within` of where they were searched for;
/// false when there are none. x is inside when it is straight behind the face it is closest to; beside an
/// edge or a vertex it counts as outside, where a tool is that comes from outside. Of equally close ones the
/// first is taken. Cost: closest_on_triangle a candidate, each of which is taken from `looks`, a
/// BoundedTotal.
template <class Profile, class Total>
[[nodiscard]] bool nearest_surface(const Forest<Profile>& forest, Candidates<Profile>& candidates,
                                   const Vector3<Position>& x, Position within, Total& looks,
                                   SurfacePoint& nearest) {
  const auto& position = forest.node.position;
  constexpr auto kFar = Acc<2 * Position::kFractionBits>::from_raw(std::numeric_limits<int64_t>::max());
  auto least = kFar;
  uint32_t best = 0;
  const auto closest_on = [&](const FaceNodes& node) {
    return closest_on_triangle(position[node[0]], position[node[1]], position[node[2]], x);
  };
  const uint32_t listed = surface_detail::list_within(within, candidates);
  for (const uint32_t look : looks.take(0, listed < looks.left() ? listed : looks.left())) {
    const uint32_t i = candidates.listed[look];
    const TrianglePoint closest = closest_on(nodes_of(forest, candidates.face[i]));
    const auto square = square_of(Vector3<Position>(x - closest.point));
    const bool is_closer = square < least;
    least = is_closer ? square : least;
    best = is_closer ? i : best;
  }
  if (least == kFar) return false;
  nearest.node = nodes_of(forest, candidates.face[best]);
  const TrianglePoint closest = closest_on(nearest.node);
  nearest.weight = closest.weight;
  nearest.point = closest.point;
  // Nearer than this (60 nm at 64 mm) the direction is the rounding's.
  constexpr auto kOn = Acc<2 * Position::kFractionBits>::from_raw(int64_t{1} << 14);
  const Vector3<Position> d = x - nearest.point;
  const FaceNodes& node = nearest.node;
  const Direction face = triangle_normal(position[node[0]], position[node[1]], position[node[2]]);
  const bool is_on = least < kOn;
  const bool is_behind = closest.is_inner && dot(d, face).raw() < 0;
  const Direction outwards = direction_of(d);
  const Position length = component_along(d, outwards);
  nearest.normal = is_on ? face : is_behind ? Direction(-outwards) : outwards;
  nearest.distance = is_behind ? -length : length;
  return true;
}

/// Of all candidates.
template <class Profile>
[[nodiscard]] bool nearest_surface(const Forest<Profile>& forest, Candidates<Profile>& candidates,
                                   const Vector3<Position>& x, SurfacePoint& nearest) {
  auto looks = bounded_total<Candidates<Profile>::kMost>([] {});
  return nearest_surface(forest, candidates, x, Position::max(), looks, nearest);
}

}  // namespace palpate
