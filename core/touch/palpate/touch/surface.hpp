// The surface of the organ: the faces of leaves without a neighbour. Where it is near a point is found anew
// in every tick, so nothing has to survive a change of the mesh: a face that is split or merged is seen as it
// is in the same tick, and a tool that arrives, however fast, is seen in the tick in which it is within the
// range.
//
//   find_candidates   one look at all nodes and leaves; keeps the faces whose box is near the tool, at most
//                     Profile::kContactCandidates of them
//   nearest_surface   the closest point on the candidates, exactly
//
// When more faces are in range than there is room for, the range shrinks until the nearest ones fit; `range`
// is what it ended at, and every face of the surface within it is among the candidates.
#pragma once

#include "palpate/touch/sides.hpp"
#include "palpate/touch/triangle.hpp"

namespace palpate {

/// Nodes of a face, counterclockwise as seen from outside.
using FaceNodes = std::array<uint16_t, 3>;

/// Whether g1, g2, g3 of a leaf are a left-handed system at rest.
inline bool is_mirrored(Axes axes) {
  const bool odd = !is_even_order(axes.axis(0), axes.axis(1));
  return (odd != axes.is_negative(0)) != (axes.is_negative(1) != axes.is_negative(2));
}

/// The face opposite w_face. What is outside follows from the rest shape, so a tet that is inside out does
/// not turn it.
inline FaceNodes face_nodes(const Leaf& leaf, uint32_t face) {
  constexpr uint8_t kPlaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  const uint8_t* place = kPlaces[face];
  const bool swap = is_mirrored(leaf.axes());
  return FaceNodes{leaf.node[place[0]], leaf.node[place[swap ? 2 : 1]], leaf.node[place[swap ? 1 : 2]]};
}

struct Candidate {
  FaceNodes node;
  Position bound;  // the face is at least this far from where the search was
};

template <class Profile>
struct Candidates {
  static constexpr uint32_t kMost = Profile::kContactCandidates;
  static constexpr uint32_t kLooks = 3 * kMost;  // at faces in reach
  uint32_t count;
  Position range;
  std::array<Candidate, kMost> face;
  Sides<Profile> sides;
};

namespace surface_detail {

/// Distance to the box around a triangle in the maximum norm: never more than that to the triangle.
inline Position distance_to_box(const Vector3<Position>& a, const Vector3<Position>& b,
                                const Vector3<Position>& c, const Vector3<Position>& x) {
  const auto along = [&](Eigen::Index axis) {
    const Position low_ab = a[axis] < b[axis] ? a[axis] : b[axis];
    const Position high_ab = a[axis] < b[axis] ? b[axis] : a[axis];
    const Position low = (c[axis] < low_ab ? c[axis] : low_ab) - x[axis];
    const Position high = x[axis] - (c[axis] > high_ab ? c[axis] : high_ab);
    return low > high ? low : high;
  };
  const auto larger = [](Position p, Position q) { return p > q ? p : q; };
  return larger(larger(along(0), along(1)), larger(along(2), Position::from_raw(0)));
}

inline constexpr uint32_t kTightenings = 8;

/// Lowers the range by a quarter at least, but not below the nearest candidate's bound, and drops what is
/// beyond: one at least, unless all are equally near.
template <class Profile>
void tighten(Candidates<Profile>& found) {
  constexpr uint32_t kMost = Candidates<Profile>::kMost;
  Position low = found.face[0].bound;
  Position high = low;
  for (const uint32_t i : bounded<kMost>(found.count, [] {})) {
    const Position bound = found.face[i].bound;
    low = bound < low ? bound : low;
    high = bound > high ? bound : high;
  }
  const Position middle = Position::from_raw(low.raw() + (high.raw() - low.raw()) / 2);
  const Position less = Position::from_raw(found.range.raw() - found.range.raw() / 4);
  const Position wanted = middle < less ? middle : less;
  const Position kept_range = wanted > low ? wanted : low;
  found.range = kept_range < found.range ? kept_range : found.range;
  uint32_t kept = 0;
  for (const uint32_t i : bounded<kMost>(found.count, [] {})) {
    if (found.face[i].bound > found.range) continue;
    found.face[kept] = found.face[i];
    ++kept;
  }
  found.count = kept;
}

template <class Profile, class Total>
void offer(const FaceNodes& node, Position bound, Total& tightenings, Candidates<Profile>& found) {
  const bool is_full = found.count == Candidates<Profile>::kMost;
  const uint32_t wanted = is_full && tightenings.left() > 0 ? 1 : 0;
  for ([[maybe_unused]] const uint32_t i : tightenings.take(0, wanted)) tighten(found);
  if (bound > found.range) return;
  if (found.count == Candidates<Profile>::kMost) {
    // No room for it: the range ends before it.
    found.range = bound - Position::from_raw(1);
    return;
  }
  found.face[found.count] = Candidate{node, bound};
  ++found.count;
}

}  // namespace surface_detail

/// All faces of the surface within `range` of `centre` in the maximum norm, both within +-5 edges. If they
/// are so many that not all can be looked at, as of an organ that is crumpled up, the range is below 0 in the
/// end. O(nodes + leaves): 6 differences a node and a test of four neighbours a leaf; 9 comparisons for a
/// face in range, and at most 8 times a pass over the candidates when they do not all fit.
template <class Profile, uint32_t Tightenings = surface_detail::kTightenings,
          uint32_t Looks = Candidates<Profile>::kLooks>
void find_candidates(const Forest<Profile>& forest, const Vector3<Position>& centre, Position range,
                     Candidates<Profile>& found) {
  found.count = 0;
  found.range = range;
  found.sides.find(forest, centre, range);
  const auto& x = forest.node.position;
  auto tightenings = bounded_total<Tightenings>([] {});
  auto looks = bounded_total<Looks>([] {});
  for (const uint32_t i : bounded<Profile::kLeaves>(forest.leaf_count, [] {})) {
    const Leaf& leaf = forest.leaf[i];
    uint32_t faces = found.sides.faces_in_reach(leaf);
    if (faces == 0) continue;
    const uint32_t in_pairs = faces - ((faces >> 1) & 5u);
    const uint32_t count = (in_pairs & 3u) + (in_pairs >> 2);
    if (looks.left() < count) {
      found.range = Position::from_raw(-1);
      return;
    }
    for ([[maybe_unused]] const uint32_t look : looks.take(0, count)) {
      const auto face = static_cast<uint32_t>(31 - leading_zeros(faces));
      faces ^= 1u << face;
      const FaceNodes node = face_nodes(leaf, face);
      const Position bound = surface_detail::distance_to_box(x[node[0]], x[node[1]], x[node[2]], centre);
      if (bound <= found.range) surface_detail::offer(node, bound, tightenings, found);
    }
  }
}

/// All or none of them: where they do not all fit, the range is below 0.
template <class Profile>
void find_all_candidates(const Forest<Profile>& forest, const Vector3<Position>& centre, Position range,
                         Candidates<Profile>& found) {
  find_candidates<Profile, 0, Candidates<Profile>::kMost>(forest, centre, range, found);
}

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
[[nodiscard]] bool nearest_surface(const Forest<Profile>& forest, const Candidates<Profile>& candidates,
                                   const Vector3<Position>& x, Position within, Total& looks,
                                   SurfacePoint& nearest) {
  const auto& position = forest.node.position;
  constexpr auto kFar = Acc<2 * Position::kFractionBits>::from_raw(std::numeric_limits<int64_t>::max());
  auto least = kFar;
  bool is_inner = false;
  for (const uint32_t i : bounded<Candidates<Profile>::kMost>(candidates.count, [] {})) {
    const Candidate& candidate = candidates.face[i];
    if (candidate.bound > within || looks.left() == 0) continue;
    for ([[maybe_unused]] const uint32_t look : looks.take(0, 1)) {
      const FaceNodes& node = candidate.node;
      const TrianglePoint closest =
          closest_on_triangle(position[node[0]], position[node[1]], position[node[2]], x);
      const auto square = square_of(Vector3<Position>(x - closest.point));
      if (square >= least) continue;
      least = square;
      is_inner = closest.is_inner;
      nearest.node = node;
      nearest.weight = closest.weight;
      nearest.point = closest.point;
    }
  }
  if (least == kFar) return false;
  // Nearer than this (60 nm at 64 mm) the direction is the rounding's.
  constexpr auto kOn = Acc<2 * Position::kFractionBits>::from_raw(int64_t{1} << 14);
  const Vector3<Position> d = x - nearest.point;
  const FaceNodes& node = nearest.node;
  const Direction face = triangle_normal(position[node[0]], position[node[1]], position[node[2]]);
  const bool is_on = least < kOn;
  const bool is_behind = is_inner && dot(d, face).raw() < 0;
  const Direction outwards = direction_of(d);
  const Position length = component_along(d, outwards);
  nearest.normal = is_on ? face : is_behind ? Direction(-outwards) : outwards;
  nearest.distance = is_behind ? -length : length;
  return true;
}

/// Of all candidates.
template <class Profile>
[[nodiscard]] bool nearest_surface(const Forest<Profile>& forest, const Candidates<Profile>& candidates,
                                   const Vector3<Position>& x, SurfacePoint& nearest) {
  auto looks = bounded_total<Candidates<Profile>::kMost>([] {});
  return nearest_surface(forest, candidates, x, Position::max(), looks, nearest);
}

}  // namespace palpate
