// A leaf of the bisection forest: a tet of the simulation mesh.
#pragma once

#include "palpate/mesh/block.hpp"
#include "palpate/mesh/tet_shape.hpp"

namespace palpate {

/// What a leaf is by its descent, in one word, which a hot loop loads at once:
///   bits 0 .. 13   path: from its root a bit a level, which child, the last one lowest
///        14 .. 22  axes (tet_shape.hpp)
///        23 .. 25  region of its root's cube
///        28 .. 31  level
class LeafKind {
 public:
  LeafKind() = default;
  constexpr LeafKind(uint32_t path, Axes axes, uint32_t region, uint32_t level)
      : word_(path | uint32_t{axes.code()} << kAxesAt | region << kRegionAt | level << kLevelAt) {}

  [[nodiscard]] constexpr uint32_t path() const { return word_ & ((1u << kAxesAt) - 1u); }
  [[nodiscard]] constexpr Axes axes() const { return Axes::of_code((word_ >> kAxesAt) & Axes::kMostCode); }
  [[nodiscard]] constexpr uint8_t region() const { return (word_ >> kRegionAt) & (kRegions - 1u); }
  [[nodiscard]] constexpr uint8_t level() const { return static_cast<uint8_t>(word_ >> kLevelAt); }

  /// Of child 0 or 1. Its level is kDeepestLevel at most.
  [[nodiscard]] constexpr LeafKind child(uint32_t which) const {
    const Axes of_child = which == 0 ? axes() : axes().of_second_child(type_of_level(level()));
    return LeafKind(2 * path() + which, of_child, region(), level() + 1u);
  }
  /// Of a child 0: its parent.
  [[nodiscard]] constexpr LeafKind parent() const {
    return LeafKind(path() / 2, axes(), region(), level() - 1u);
  }

 private:
  static constexpr uint32_t kAxesAt = kDeepestLevel;
  static constexpr uint32_t kRegionAt = kAxesAt + Axes::kBits;
  static constexpr uint32_t kLevelAt = 28;
  static_assert(kRegionAt + 3 <= kLevelAt && kRegions == 8 && kDeepestLevel < 16);

  uint32_t word_;
};

/// Whole words to the last byte, so that a copy needs no call.
struct alignas(uint32_t) Leaf {
  std::array<uint16_t, 4> node;       // w0 .. w3 in bisection order (tet_shape.hpp)
  std::array<uint16_t, 4> neighbour;  // the leaf tet across the face opposite w_i, or kNone on the surface
  uint16_t tet;
  uint16_t group;  // whose rotation it uses
  LeafKind kind;

  [[nodiscard]] uint32_t path() const { return kind.path(); }
  [[nodiscard]] Axes axes() const { return kind.axes(); }
  [[nodiscard]] uint8_t region() const { return kind.region(); }
  [[nodiscard]] uint8_t level() const { return kind.level(); }
};

/// Which child of its ancestor at `level`, above its own, a leaf lies in.
inline uint32_t child_towards(const Leaf& leaf, uint8_t level) {
  return (leaf.path() >> (leaf.level() - level - 1)) & 1u;
}

/// Face (0 .. 3) that a leaf shares with a neighbouring tet.
inline uint32_t face_towards(const Leaf& leaf, uint16_t tet) {
  const auto is_at = [&](uint32_t face) { return leaf.neighbour[face] == tet ? 1u : 0u; };
  return is_at(1) | 2 * is_at(2) | 3 * is_at(3);
}

}  // namespace palpate
