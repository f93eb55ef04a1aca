// Faces of the surface that are near a point: one look at all nodes and leaves, which keeps the faces whose
// box is near the tool, at most Profile::kContactCandidates of them.
#pragma once

#include "palpate/touch/direction.hpp"
#include "palpate/touch/sides.hpp"

namespace palpate {

struct Candidate {
  uint32_t face;   // four times its leaf's place, and w_face
  Position bound;  // the face is at least this far from where the search was
};

template <class Profile>
struct Candidates {
  static constexpr uint32_t kMost = Profile::kContactCandidates;
  static constexpr uint32_t kLooks = 3 * kMost;  // at faces in reach
  union {
    Sides<Profile> sides;  // scratch of a search, until all leaves are listed
    std::array<Candidate, kMost + 1> face;
  };
  // Scratch. Of a search 16 times the place of a leaf, and its Sides::faces_in_reach, and 0 behind the last
  // one; then the places of candidates that are near enough to be looked at closely.
  std::array<uint32_t, kLooks + 3> listed;
  uint32_t count;
  Position range;
};

namespace surface_detail {

/// Of coordinates: their difference fits. No branch.
inline Position smaller(Position a, Position b) {
  return a - Position::from_raw(not_below_zero((a - b).raw()));
}
inline Position larger(Position a, Position b) {
  return b + Position::from_raw(not_below_zero((a - b).raw()));
}

/// 1 for a face that may be as near as `range`, else 0.
inline uint32_t is_within(Position bound, Position range) { return bound <= range ? 1 : 0; }

/// Distance to the box around a triangle in the maximum norm: never more than that to the triangle.
inline Position distance_to_box(const Vector3<Position>& a, const Vector3<Position>& b,
                                const Vector3<Position>& c, Position x0, Position x1, Position x2) {
  const auto along = [&](Eigen::Index axis, Position x) {
    const Position low = smaller(c[axis], smaller(a[axis], b[axis]));
    const Position high = larger(c[axis], larger(a[axis], b[axis]));
    return larger(low - x, x - high);
  };
  const Position farthest = larger(larger(along(0, x0), along(1, x1)), along(2, x2));
  return Position::from_raw(not_below_zero(farthest.raw()));
}

inline constexpr uint32_t kTightenings = 8;

/// A search's state: how many are kept, the sum of their bounds, in units of what so many may be together in
/// a word, and how near the surface is known.
struct Room {
  uint32_t count;
  uint32_t sum;
  Position range;
};

/// Bits that a bound has less in the sum of kMost of them.
template <class Profile>
inline constexpr int kSumShift = 32 - leading_zeros(Candidates<Profile>::kMost - 1);

/// Of candidates that fill the room: lowers the range to their mean, and drops what is beyond, one at least
/// unless all are equally near.
template <class Profile>
PALPATE_ALWAYS_INLINE Room tightened(Room room, Candidates<Profile>& found) {
  constexpr uint32_t kMost = Candidates<Profile>::kMost;
  constexpr int kShift = kSumShift<Profile>;
  const auto mean = Position::from_raw(static_cast<int32_t>((room.sum / kMost + 1) << kShift));
  const Position range = smaller(mean, room.range);
  Room left{0, 0, range};
  const auto keep = [&](uint32_t face, Position bound) {
    found.face[left.count].face = face;
    found.face[left.count].bound = bound;
    const int32_t beyond = if_below((range - bound).raw());
    left.count += static_cast<uint32_t>(beyond + 1);
    left.sum += static_cast<uint32_t>((bound.raw() >> kShift) & ~beyond);
  };
  for (const uint32_t pair : bounded<kMost / 2>(kMost / 2, [] {})) {
    // All is loaded before any is stored: a load may have to wait for a store.
    const Candidate& even = found.face[2 * pair];
    const Candidate& odd = found.face[2 * pair + 1];
    const uint32_t face0 = even.face, face1 = odd.face;
    const Position bound0 = even.bound, bound1 = odd.bound;
    keep(face0, bound0);
    keep(face1, bound1);
  }
  if constexpr (kMost % 2 != 0) keep(found.face[kMost - 1].face, found.face[kMost - 1].bound);
  return left;
}

/// Keeps it where it is in range and there is room for it. Where there is none the range ends before it.
template <class Profile, class Total>
PALPATE_ALWAYS_INLINE Room offered(Room room, const Candidate& candidate, Total& tightenings,
                                   Candidates<Profile>& found) {
  constexpr uint32_t kMost = Candidates<Profile>::kMost;
  const uint32_t has_left = tightenings.left() > 0 ? 1 : 0;
  const uint32_t is_too_many = room.count == kMost ? has_left : 0;
  const uint32_t wanted = is_within(candidate.bound, room.range) & is_too_many;
  for ([[maybe_unused]] const uint32_t i : tightenings.take(0, wanted)) room = tightened(room, found);
  found.face[room.count].face = candidate.face;
  found.face[room.count].bound = candidate.bound;
  // Below 0 where it is in range.
  const int32_t beyond = (candidate.bound - Position::from_raw(1) - room.range).raw();
  const int32_t has_room = static_cast<int32_t>(room.count - kMost) >> 31;
  const int32_t is_kept = (beyond & has_room) >> 31;
  return Room{room.count - static_cast<uint32_t>(is_kept),
              room.sum + static_cast<uint32_t>(candidate.bound.raw() >> kSumShift<Profile> & is_kept),
              room.range + Position::from_raw(beyond & (beyond >> 31) & ~has_room)};
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
  found.sides.find(forest, centre, range);
  const uint32_t leaves = list_leaves<Candidates<Profile>::kLooks>(
      forest, found.listed, [&](const Leaf& leaf) { return found.sides.faces_in_reach(leaf); });
  found.listed[leaves] = 0;
  surface_detail::Room room{0, 0, range};
  auto tightenings = bounded_total<Tightenings>([] {});
  // Scalars, or they would be loaded anew after every candidate that is stored.
  const Position x0 = centre[0], x1 = centre[1], x2 = centre[2];
  // Face by face in one loop: the next leaf comes when the one before has no face left.
  uint32_t next = 0;
  uint32_t leaf = 0;
  for ([[maybe_unused]] const uint32_t look : bounded<Looks>(Looks, [] {})) {
    const auto if_next = static_cast<uint32_t>(if_below(static_cast<int32_t>(leaf & 15u) - 1));
    leaf = (leaf & ~if_next) | (found.listed[next] & if_next);
    next -= if_next;
    if ((leaf & 15u) == 0) break;
    const auto face = static_cast<uint32_t>(31 - leading_zeros(leaf & 15u));
    leaf ^= 1u << face;
    const uint32_t place = leaf >> 4;
    const auto corner = [&](uint32_t k) -> const Vector3<Position>& {
      return forest.node.position[forest.leaf[place].node[(face + k) & 3u]];
    };
    const Position bound = surface_detail::distance_to_box(corner(1), corner(2), corner(3), x0, x1, x2);
    room = surface_detail::offered(room, Candidate{4 * place + face, bound}, tightenings, found);
  }
  const bool is_whole = (leaf & 15u) == 0 && next >= leaves;
  found.count = room.count;
  found.range = is_whole ? room.range : Position::from_raw(-1);
}

/// All or none of them: where they do not all fit, the range is below 0.
template <class Profile>
void find_all_candidates(const Forest<Profile>& forest, const Vector3<Position>& centre, Position range,
                         Candidates<Profile>& found) {
  find_candidates<Profile, 0, Candidates<Profile>::kMost>(forest, centre, range, found);
}

}  // namespace palpate
