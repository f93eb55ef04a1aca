// How far the edges of a leaf are stretched: what the simulation front is refined by. All measures are
// (l / l0)^2 - 1 of an edge, which is twice its Green strain, or a difference of such strains.
#pragma once

#include "palpate/mesh/deformation_gradient.hpp"
#include "palpate/mesh/patch.hpp"
#include "palpate/remesh/rules.hpp"

namespace palpate {

/// 0 .. 16, of an edge at most 15; LSB 2^-27.
using StretchMeasure = Q<4, 27>;

/// (h / l0)^2 of an edge, a quarter of it.
using InverseSquare = Q<0, 31>;

namespace stretch_detail {

/// Of an edge whose squared length at rest is so many quarters of h^2; 1 is not in the format.
constexpr InverseSquare of_quarters(int quarters) {
  return quarters == 1 ? InverseSquare::max() : InverseSquare::ratio(1, quarters);
}

/// Of the edges by type, in the order 01, 02, 03, 12, 13, 23.
inline constexpr InverseSquare kInverses[3][6] = {
    {of_quarters(4), of_quarters(8), of_quarters(12), of_quarters(4), of_quarters(8), of_quarters(4)},
    {of_quarters(4), of_quarters(8), of_quarters(3), of_quarters(4), of_quarters(3), of_quarters(3)},
    {of_quarters(4), of_quarters(2), of_quarters(3), of_quarters(2), of_quarters(3), of_quarters(1)}};
/// From w0 to w3, w2 and w1.
inline constexpr InverseSquare kInversesOfRefinementEdge[3] = {kInverses[0][2], kInverses[1][1],
                                                               kInverses[2][0]};

/// x >> shift, rounded to nearest, for 1 <= shift <= 31; 2^31 - 1 when that is less. Without a branch.
constexpr uint32_t shifted_down(uint64_t x, uint32_t shift) {
  const auto high = static_cast<uint32_t>(x >> 32);
  const auto low = static_cast<uint32_t>(x);
  const uint32_t rounded = (high << (32 - shift) | low >> shift) + (low >> (shift - 1) & 1u);
  const uint32_t too_high = high >> (shift - 1) | rounded >> 31;
  return too_high == 0 ? rounded : 0x7fffffffu;
}

}  // namespace stretch_detail

namespace stretch_detail {

inline constexpr uint32_t kOne = 1u << StretchMeasure::kFractionBits;

/// (l / l0)^2 with the fraction bits of StretchMeasure, 2^31 - 1 when it is more. h = 2^-size.
PALPATE_ALWAYS_INLINE uint32_t elongation(Position x, Position y, Position z, uint32_t size,
                                          InverseSquare inverse) {
  const auto square = static_cast<uint64_t>((x * x + y * y + z * z).raw());
  // (l / h)^2 as Q<6, 25>; then (l / l0)^2, with 54 fraction bits since `inverse` is a quarter.
  const uint32_t relative = shifted_down(square, 29 - 2 * size);
  const uint64_t ratio = uint64_t{relative} * static_cast<uint32_t>(inverse.raw());
  return shifted_down(ratio, 54 - StretchMeasure::kFractionBits);
}

/// Less one; 0 when the edge is shorter than at rest.
constexpr StretchMeasure above_one(uint32_t elongation) {
  return StretchMeasure::from_raw(static_cast<int32_t>((elongation > kOne ? elongation : kOne) - kOne));
}

}  // namespace stretch_detail

/// (l / l0)^2 - 1 of the edge between two nodes; 0 when it is shorter than at rest, 15 when it is longer than
/// 4 l0. h = 2^-size.
template <uint16_t Capacity>
StretchMeasure edge_stretch(const NodeState<Capacity>& node, uint16_t a, uint16_t b, uint32_t size,
                            InverseSquare inverse) {
  const Position x = node.position[a][0] - node.position[b][0];  // within +-8
  const Position y = node.position[a][1] - node.position[b][1];
  const Position z = node.position[a][2] - node.position[b][2];
  return stretch_detail::above_one(stretch_detail::elongation(x, y, z, size, inverse));
}

/// Of the edge that a bisection halves, of a tet at this level.
template <uint16_t Capacity>
StretchMeasure refinement_edge_stretch(const NodeState<Capacity>& node, const EdgeEnds& ends, uint8_t level) {
  return edge_stretch(node, ends[0], ends[1], size_of_level(level),
                      stretch_detail::kInversesOfRefinementEdge[static_cast<uint32_t>(type_of_level(level))]);
}

template <class Profile>
StretchMeasure longest_edge_stretch(const Forest<Profile>& forest, const Leaf& leaf) {
  return refinement_edge_stretch(forest.node, refinement_edge(leaf), leaf.level());
}

/// The largest of all six edges. Three of them make the others.
template <class Profile>
StretchMeasure largest_edge_stretch(const Forest<Profile>& forest, const Leaf& leaf) {
  const auto& inverses = stretch_detail::kInverses[static_cast<uint32_t>(type_of_level(leaf.level()))];
  const uint32_t size = size_of_level(leaf.level());
  uint32_t largest = 0;
  const auto see = [&](Position x, Position y, Position z, uint32_t edge) {
    const uint32_t elongation = stretch_detail::elongation(x, y, z, size, inverses[edge]);
    largest = elongation > largest ? elongation : largest;
  };
  const auto& x0 = forest.node.position[leaf.node[0]];
  const auto& x1 = forest.node.position[leaf.node[1]];
  const auto& x2 = forest.node.position[leaf.node[2]];
  const auto& x3 = forest.node.position[leaf.node[3]];
  const Position ax = x1[0] - x0[0], ay = x1[1] - x0[1], az = x1[2] - x0[2];
  const Position bx = x2[0] - x1[0], by = x2[1] - x1[1], bz = x2[2] - x1[2];
  const Position cx = x3[0] - x2[0], cy = x3[1] - x2[1], cz = x3[2] - x2[2];
  see(ax, ay, az, 0);
  see(bx, by, bz, 3);
  see(ax + bx, ay + by, az + bz, 1);
  see(cx, cy, cz, 5);
  const Position dx = bx + cx, dy = by + cy, dz = bz + cz;
  see(dx, dy, dz, 4);
  see(ax + dx, ay + dy, az + dz, 2);
  return stretch_detail::above_one(largest);
}

/// F^T F of a leaf, entries within +-48.
template <class Profile>
Matrix3<Q<6, 25>> cauchy_green(const Forest<Profile>& forest, const Leaf& leaf) {
  const auto& x = forest.node.position;
  uint32_t clamped = 0;
  const DeformationGradient f =
      deformation_gradient(edge_vectors(type_of_level(leaf.level()), x[leaf.node[0]], x[leaf.node[1]],
                                        x[leaf.node[2]], x[leaf.node[3]]),
                           leaf.axes(), leaf.level(), clamped);
  return narrow<Q<6, 25>>(f.transpose() * f);
}

/// Twice the largest entry of the difference of Green strains to a neighbour across a face.
template <class Profile>
StretchMeasure strain_jump(const Forest<Profile>& forest, const Leaf& leaf) {
  const Matrix3<Q<6, 25>> own = cauchy_green(forest, leaf);
  StretchMeasure largest = StretchMeasure::from_raw(0);
  for (const uint32_t face : bounded<4>(4, [] {})) {
    if (leaf.neighbour[face] == kNone) continue;
    const Matrix3<Q<6, 25>> other = cauchy_green(forest, forest.leaf_of(leaf.neighbour[face]));
    for (const uint32_t i : bounded<9>(9, [] {})) {
      const Acc<27> difference = widen<27>(own.data()[i]) - widen<27>(other.data()[i]);  // within +-96
      const auto jump = narrow_saturated<StretchMeasure>(difference.raw() < 0 ? -difference : difference);
      largest = jump > largest ? jump : largest;
    }
  }
  return largest;
}

}  // namespace palpate
