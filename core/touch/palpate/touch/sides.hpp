// On which sides of a box around a point the nodes are: what is beyond the same side with all of its nodes
// does not reach into the box. Two differences a node and axis, instead of those of every face and leaf.
// Nodes and leaves are taken by twos: a branch costs a Cortex-M7 a quarter of what one of them does.
#pragma once

#include "palpate/mesh/forest.hpp"
#include "palpate/numeric/opaque.hpp"

namespace palpate {

template <class Profile>
class Sides {
 public:
  /// Of the box of points within `range` of `centre` in the maximum norm, all within +-5 edges. O(nodes).
  void find(const Forest<Profile>& forest, const Vector3<Position>& centre, Position range) {
    const Vector3<Position> low = centre - Vector3<Position>(range, range, range);
    const Position width = range + range;
    const auto& nodes = forest.nodes;
    const auto beyond = [&](uint16_t node) {
      const Vector3<Position>& x = forest.node.position[node];
      return beyond_along<0>(x, low, width) | beyond_along<1>(x, low, width) | beyond_along<2>(x, low, width);
    };
    const auto put = [&](uint16_t node, uint32_t sides) { beyond_[node] = static_cast<uint8_t>(sides); };
    for (const uint32_t pair : bounded<Profile::kNodes / 2>(nodes.used() / 2u, [] {})) {
      const uint16_t node0 = nodes.live(2 * pair);
      const uint16_t node1 = nodes.live(2 * pair + 1);
      uint32_t beyond0 = beyond(node0);
      uint32_t beyond1 = beyond(node1);
      have_both(beyond0, beyond1);
      put(node0, beyond0);
      put(node1, beyond1);
    }
    if (nodes.used() % 2 != 0) {
      const uint16_t last = nodes.live(nodes.used() - 1u);
      put(last, beyond(last));
    }
  }
  /// Faces of a leaf that have no neighbour and are not beyond a side: bit i for the face opposite w_i. No
  /// branch: four faces at once, one a byte.
  [[nodiscard]] uint32_t faces_in_reach(const Leaf& leaf) const {
    // Of a halfword's sign: only kNone has it.
    static_assert(kNone == 0xffff && Forest<Profile>::kTets <= 0x8000);
    constexpr uint32_t kSigns = 0x80008000u;
    // Where a face's neighbour has its sign, which is at 15, 31, 7, and 23 for faces 0 .. 3, its three nodes
    // come together: of this byte and the next two.
    const uint32_t nodes = of(leaf, 0) | of(leaf, 3) << 8 | of(leaf, 1) << 16 | of(leaf, 2) << 24;
    const uint32_t beyond = nodes & (nodes >> 8 | nodes << 24) & (nodes >> 16 | nodes << 16);
    const uint32_t surface = (two_neighbours(leaf, 0) & kSigns) | (two_neighbours(leaf, 2) & kSigns) >> 8;
    // Only 0 takes nothing from a byte's sign.
    const uint32_t faces = surface & (0x80808080u - beyond);
    constexpr uint32_t kInOrder = 1u << (32 - 15) | 1u << (33 - 31) | 1u << (34 - 7) | 1u << (35 - 23);
    return static_cast<uint32_t>(uint64_t{faces} * kInOrder >> 32) & 15u;
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
    // Opaque, or the loop would keep the high sides as well as the low ones.
    const Position from_low = Position::from_raw(opaque((x[Axis] - low[Axis]).raw()));
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

/// Lists the leaves of which `bits_of(leaf)`, below 16, is not 0: 16 times the place of each, and its bits.
/// Returns how many there are; Most + 1, cut off, where they are more. No branch, two leaves at once; room is
/// for two more than Most + 1.
template <uint32_t Most, class Profile, std::size_t Room, class Bits>
PALPATE_NOINLINE uint32_t list_leaves(const Forest<Profile>& forest, std::array<uint32_t, Room>& listed,
                                      Bits bits_of) {
  static_assert(Room >= Most + 3);
  uint32_t count = 0;
  const auto list = [&](uint32_t place, uint32_t bits) {
    listed[count] = 16 * place + bits;
    count += bits != 0 ? 1 : 0;
  };
  for (const uint32_t pair : bounded<Profile::kLeaves / 2>(forest.leaf_count / 2u, [] {})) {
    uint32_t bits0 = bits_of(forest.leaf[2 * pair]);
    uint32_t bits1 = bits_of(forest.leaf[2 * pair + 1]);
    have_both(bits0, bits1);
    list(2 * pair, bits0);
    list(2 * pair + 1, bits1);
    count = count <= Most ? count : Most + 1;
  }
  return count;
}

}  // namespace palpate
