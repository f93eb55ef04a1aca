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
    for (const uint32_t i : bounded<Profile::kNodes>(forest.nodes.used(), [] {})) {
      const uint16_t node = forest.nodes.live(i);
      const Vector3<Position>& x = forest.node.position[node];
      const uint32_t beyond = beyond_along<0>(x, centre, range) | beyond_along<1>(x, centre, range) |
                              beyond_along<2>(x, centre, range);
      beyond_[node] = static_cast<uint8_t>(beyond);
    }
  }
  /// Faces of a leaf that have no neighbour and are not beyond a side: bit i for the one opposite w_i. No
  /// branch.
  [[nodiscard]] uint32_t faces_in_reach(const Leaf& leaf) const {
    const uint32_t side[4] = {of(leaf, 0), of(leaf, 1), of(leaf, 2), of(leaf, 3)};
    const auto if_in_reach = [&](uint32_t face, uint32_t beyond) {
      const uint32_t is_surface = (leaf.neighbour[face] + 1u) >> 16;  // kNone is the largest number
      const uint32_t is_near = (beyond - 1u) >> 31;
      return (is_surface & is_near) << face;
    };
    static_assert(kNone == 0xffff);
    return if_in_reach(0, side[1] & side[2] & side[3]) | if_in_reach(1, side[0] & side[2] & side[3]) |
           if_in_reach(2, side[0] & side[1] & side[3]) | if_in_reach(3, side[0] & side[1] & side[2]);
  }
  /// Whether a leaf is.
  [[nodiscard]] bool is_beyond(const Leaf& leaf) const {
    return (of(leaf, 0) & of(leaf, 1) & of(leaf, 2) & of(leaf, 3)) != 0;
  }

 private:
  [[nodiscard]] uint32_t of(const Leaf& leaf, uint32_t place) const { return beyond_[leaf.node[place]]; }

  template <Eigen::Index Axis>
  PALPATE_ALWAYS_INLINE static uint32_t beyond_along(const Vector3<Position>& x,
                                                     const Vector3<Position>& centre, Position range) {
    const Position from_centre = x[Axis] - centre[Axis];
    const uint32_t above = static_cast<uint32_t>((range - from_centre).raw()) >> 31;
    const uint32_t below = static_cast<uint32_t>((range + from_centre).raw()) >> 31;
    return (above | below << 1) << (2 * Axis);
  }

  std::array<uint8_t, Profile::kNodes> beyond_;
};

}  // namespace palpate
