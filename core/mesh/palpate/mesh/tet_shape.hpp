// The three shapes. A root is a Kuhn tetrahedron of a cube; bisection at the midpoint of the longest edge
// goes through TYPE0 -> TYPE1 -> TYPE2 -> TYPE0 of half the size, so type = level mod 3 and size = level / 3
// (Maubach 1995: a vertex order carries the refinement edge from parent to child).
//
// With the vertices w0..w3 in that order, three edge-like vectors g1, g2, g3 are axis-parallel at rest and
// have length h = 2^-size cube edges:
//   TYPE0  g1 = w1 - w0   g2 = w2 - w1          g3 = w3 - w2
//   TYPE1  g1 = w1 - w0   g2 = w2 - w1          g3 = 2 w3 - w0 - w2
//   TYPE2  g1 = w1 - w0   g2 = 2 w2 - w0 - w1   g3 = 2 (w3 - w2)
// so the deformation gradient is made of differences and a shift; Axes says which signed axis each one is.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate {

enum class TetType : uint8_t { kType0 = 0, kType1 = 1, kType2 = 2 };

/// h = 2^-size_of_level cube edges. A third of the level, to level 30 without a division.
constexpr uint8_t size_of_level(uint32_t level) { return static_cast<uint8_t>((level * 11u) >> 5u); }
constexpr TetType type_of_level(uint32_t level) {
  return static_cast<TetType>(level - 3u * size_of_level(level));
}

/// Nodes that the leaves of one root tet can have, down to level `deepest`: the points of a lattice with n
/// steps to a cube edge that lie in a Kuhn tetrahedron.
constexpr uint32_t most_nodes_of_root(uint32_t deepest) {
  const uint32_t n = 1u << size_of_level(deepest + 2);
  return (n + 1) * (n + 2) * (n + 3) / 6;
}

/// The refinement edge joins w0 and w[refinement_end]; in both children the midpoint takes place
/// refinement_end.
constexpr uint32_t refinement_end(TetType type) { return 3 - static_cast<uint32_t>(type); }

/// The other two vertices of a tet with that refinement edge.
struct EdgeOthers {
  uint32_t first, second;
};
constexpr EdgeOthers others(uint32_t end) { return EdgeOthers{end == 1 ? 2u : 1u, end == 3 ? 2u : 3u}; }

/// Whether x, y and z in an order that begins with these two are an even permutation.
constexpr bool is_even_order(uint32_t first, uint32_t second) {
  return first + 1 == second || first == second + 2;
}

/// Signed axes of g1, g2, g3 at rest: three bits each, axis in the low two and sign in the third.
class Axes {
 public:
  static constexpr uint32_t kBits = 9;
  static constexpr uint32_t kMostCode = (1u << kBits) - 1u;

  Axes() = default;
  static constexpr Axes of(uint32_t axis1, uint32_t axis2, uint32_t axis3) {
    return Axes(axis1 | (axis2 << 3) | (axis3 << 6));
  }
  static constexpr Axes of_code(uint32_t code) { return Axes(code); }
  [[nodiscard]] constexpr uint32_t axis(uint32_t k) const { return (code_ >> (3 * k)) & 3u; }
  [[nodiscard]] constexpr bool is_negative(uint32_t k) const { return ((code_ >> (3 * k + 2)) & 1u) != 0; }
  [[nodiscard]] constexpr uint16_t code() const { return code_; }

  /// Axes of child 1 of a tet of this type; child 0 keeps its parent's.
  [[nodiscard]] constexpr Axes of_second_child(TetType type) const {
    const uint32_t a = code_ & 7u;
    const uint32_t b = (code_ >> 3) & 7u;
    const uint32_t c = (code_ >> 6) & 7u;
    const uint32_t minus_a = a ^ 4u;
    switch (type) {
      case TetType::kType0:
        return Axes(b | (c << 3) | (minus_a << 6));
      case TetType::kType1:
        return Axes(b | (minus_a << 3) | (c << 6));
      default:
        return Axes(minus_a | (b << 3) | (c << 6));
    }
  }
  friend constexpr bool operator==(Axes a, Axes b) { return a.code_ == b.code_; }

 private:
  constexpr explicit Axes(uint32_t code) : code_(static_cast<uint16_t>(code)) {}
  uint16_t code_;
};

/// g_k = sum over i of coefficient[type][k][i] w_i: the table that the code above spells out, for tests and
/// forces.
inline constexpr int8_t kEdgeCoefficients[3][3][4] = {
    {{-1, 1, 0, 0}, {0, -1, 1, 0}, {0, 0, -1, 1}},
    {{-1, 1, 0, 0}, {0, -1, 1, 0}, {-1, 0, -1, 2}},
    {{-1, 1, 0, 0}, {-1, -1, 2, 0}, {0, 0, -2, 2}},
};

}  // namespace palpate
