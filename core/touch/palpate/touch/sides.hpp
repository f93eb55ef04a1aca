// On which sides of a box around a point the nodes are: what is beyond the same side with all of its nodes
// does not reach into the box. Two differences a node and axis, instead of those of every face and leaf.
#pragma once

#include "palpate/mesh/forest.hpp"

namespace palpate {

template <class Profile>
class Sides {
 public:
  /// Of the box of points within `range` of `centre` in the maximum norm, all within +-5 edges. O(nodes).
  void find(const Forest<Profile>& forest, const Vector3<Position>& centre, Position range) {
    const Vector3<Position> low = centre - Vector3<Position>(range, range, range);
    const Position width = range + range;
    for (const uint32_t i : bounded<Profile::kNodes>(forest.nodes.used(), [] {})) {
      const uint16_t node = forest.nodes.live(i);
      const Vector3<Position>& x = forest.node.position[node];
      const uint32_t beyond =
          beyond_along<0>(x, low, width) | beyond_along<1>(x, low, width) | beyond_along<2>(x, low, width);
      beyond_[node] = static_cast<uint8_t>(beyond);
    }
  }
  /// Bits below those of faces_in_reach.
  static constexpr uint32_t kFreeBits = 14;

  /// Faces of a leaf that have no neighbour and are not beyond a side: bits 14, 30, 15 and 31 for the ones
  /// opposite w0 .. w3. No branch: two faces at once, one a halfword.
  [[nodiscard]] uint32_t faces_in_reach(const Leaf& leaf) const {
    // Of a halfword's sign: only kNone has it, and only 0 takes nothing from it.
    static_assert(kNone == 0xffff && Forest<Profile>::kTets <= 0x8000);
    constexpr uint32_t kSigns = 0x80008000u;
    const uint32_t side[4] = {of(leaf, 0), of(leaf, 1), of(leaf, 2), of(leaf, 3)};
    const uint32_t first = side[0] & side[1];
    const uint32_t last = side[2] & side[3];
    const auto pair = [&](uint32_t low, uint32_t beyond_low, uint32_t beyond_high) {
      return two_neighbours(leaf, low) & (kSigns - (beyond_low | beyond_high << 16)) & kSigns;
    };
    return pair(0, side[1] & last, side[0] & last) >> 1 | pair(2, side[3] & first, side[2] & first);
  }
  /// The same with bit i for the face opposite w_i; the free bits may be any.
  static constexpr uint32_t in_order(uint32_t faces) {
    return faces >> 31 << 3 | (faces >> 13 & 4u) | (faces >> 29 & 2u) | (faces >> 14 & 1u);
  }
  /// Whether a leaf is.
  [[nodiscard]] bool is_beyond(const Leaf& leaf) const {
    return (of(leaf, 0) & of(leaf, 1) & of(leaf, 2) & of(leaf, 3)) != 0;
  }

 private:
  [[nodiscard]] uint32_t of(const Leaf& leaf, uint32_t place) const { return beyond_[leaf.node[place]]; }

  template <Eigen::Index Axis>
  PALPATE_ALWAYS_INLINE static uint32_t beyond_along(const Vector3<Position>& x, const Vector3<Position>& low,
                                                     Position width) {
    const Position from_low = x[Axis] - low[Axis];
    const uint32_t above = static_cast<uint32_t>((width - from_low).raw()) >> 31;
    const uint32_t below = static_cast<uint32_t>(from_low.raw()) >> 31;
    return (above | below << 1) << (2 * Axis);
  }
  /// Of two neighbours the first in the lower half: one load.
  static uint32_t two_neighbours(const Leaf& leaf, uint32_t first) {
    static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ && offsetof(Leaf, neighbour) % 4 == 0);
    uint32_t both = 0;
    __builtin_memcpy(&both, __builtin_assume_aligned(&leaf.neighbour[first], 4), sizeof(both));
    return both;
  }

  std::array<uint8_t, Profile::kNodes> beyond_;
};

}  // namespace palpate
