// How far the edges of a leaf are stretched: what the simulation front is refined by. All measures are
// (l / l0)^2 - 1 of an edge, which is twice its Green strain, or a difference of such strains.
#pragma once

#include "palpate/mesh/deformation_gradient.hpp"
#include "palpate/mesh/patch.hpp"
#include "palpate/remesh/rules.hpp"

namespace palpate {

/// 0 .. 16, LSB 2^-27.
using StretchMeasure = Q<4, 27>;

namespace stretch_detail {

/// Squared rest lengths of edges in quarters of h^2 are 1, 2, 3, 4, 8 and 12.
inline constexpr uint32_t kMostQuarters = 12;
using Inverse = Q<0, 31>;
inline constexpr Inverse kNoEdge = Inverse::from_raw(0);
inline constexpr auto kInverse = [] {
  std::array<Inverse, kMostQuarters + 1> inverse{};
  inverse[1] = Inverse::max();  // 1 is not in the format
  inverse[2] = Inverse::ratio(1, 2);
  inverse[3] = Inverse::ratio(1, 3);
  inverse[4] = Inverse::ratio(1, 4);
  inverse[8] = Inverse::ratio(1, 8);
  inverse[12] = Inverse::ratio(1, 12);
  return inverse;
}();

/// |a - b|^2 of the rest points of an edge's ends, in quarters of h^2.
inline uint32_t quarters(LatticePoint a, LatticePoint b, uint32_t size) {
  const int32_t x = a.x - b.x;
  const int32_t y = a.y - b.y;
  const int32_t z = a.z - b.z;
  const auto square = static_cast<uint32_t>(x * x + y * y + z * z);
  const uint32_t scaled = (4u * square) >> (2u * (kLatticeBits - size));
  const uint32_t quarters = scaled < kMostQuarters ? scaled : kMostQuarters;
  check(kInverse[quarters] != kNoEdge, "no edge has this length at rest");
  return quarters;
}

}  // namespace stretch_detail

/// (l / l0)^2 - 1 of the edge between two nodes of a leaf of this size; 0 when it is shorter than at rest.
template <uint16_t Capacity>
StretchMeasure edge_stretch(const NodeState<Capacity>& node, uint16_t a, uint16_t b, uint32_t size) {
  const uint32_t quarters = stretch_detail::quarters(node.rest[a], node.rest[b], size);
  // In units of h, within +-4.
  using Length = Q<4, 27>;
  constexpr int32_t kLimit = int32_t{4} << Length::kFractionBits;
  const auto component = [&](Eigen::Index axis) {
    const int32_t raw = node.position[a][axis].raw() - node.position[b][axis].raw();
    const int32_t limit = kLimit >> size;
    const int32_t low = raw < -limit ? -limit : raw;
    const int32_t within = low > limit ? limit : low;
    return Length::from_raw(static_cast<int32_t>(static_cast<uint32_t>(within) << size));
  };
  const Length x = component(0);
  const Length y = component(1);
  const Length z = component(2);
  const auto square = narrow<Q<6, 25>>(x * x + y * y + z * z);  // (l / h)^2, at most 48
  const Acc<54> ratio = Acc<54>::from_raw((square * stretch_detail::kInverse[quarters]).raw());
  const auto stretch = narrow_saturated<StretchMeasure>(ratio - widen<54>(StretchMeasure::ratio(1, 1)));
  return stretch < StretchMeasure::from_raw(0) ? StretchMeasure::from_raw(0) : stretch;
}

/// Of the edge that a bisection would halve.
template <class Profile>
StretchMeasure longest_edge_stretch(const Forest<Profile>& forest, const Leaf& leaf) {
  const EdgeEnds edge = refinement_edge(leaf);
  return edge_stretch(forest.node, edge[0], edge[1], size_of_level(leaf.level));
}

/// The largest of all six edges.
template <class Profile>
StretchMeasure largest_edge_stretch(const Forest<Profile>& forest, const Leaf& leaf) {
  StretchMeasure largest = StretchMeasure::from_raw(0);
  for (const uint32_t i : bounded<3>(3, [] {})) {
    for (const uint32_t j : bounded<3>(3 - i, [] {})) {
      const StretchMeasure stretch =
          edge_stretch(forest.node, leaf.node[i], leaf.node[i + 1 + j], size_of_level(leaf.level));
      largest = stretch > largest ? stretch : largest;
    }
  }
  return largest;
}

/// F^T F of a leaf, entries within +-48.
template <class Profile>
Matrix3<Q<6, 25>> cauchy_green(const Forest<Profile>& forest, const Leaf& leaf) {
  const auto& x = forest.node.position;
  uint32_t clamped = 0;
  const DeformationGradient f =
      deformation_gradient(edge_vectors(type_of_level(leaf.level), x[leaf.node[0]], x[leaf.node[1]],
                                        x[leaf.node[2]], x[leaf.node[3]]),
                           leaf.axes, leaf.level, clamped);
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
