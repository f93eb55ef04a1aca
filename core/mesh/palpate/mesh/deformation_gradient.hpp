// The deformation gradient F of a tet, without a matrix product: in lattice units the three edge vectors of
// tet_shape.hpp are F's columns up to sign, order and a power of two.
#pragma once

#include "palpate/mesh/forest.hpp"

namespace palpate {

/// Entries of F: +-32, LSB 2^-26. Clamped to +-kStretchLimit.
using Stretch = Q<5, 26>;
using DeformationGradient = Matrix3<Stretch>;
inline constexpr int kStretchLimit = 4;

inline DeformationGradient unstretched() {
  const Stretch one = Stretch::ratio(1, 1);
  const Stretch zero = Stretch::from_raw(0);
  DeformationGradient f;
  for (const uint32_t i : bounded<9>(9, [] {})) f.data()[i] = i % 4 == 0 ? one : zero;
  return f;
}

using EdgeVector = Vector3<Position>;

struct EdgeVectors {
  EdgeVector g1, g2, g3;
};

/// g1, g2, g3 of a tet from the positions of its vertices, all within kPositionLimit.
inline EdgeVectors edge_vectors(TetType type, const EdgeVector& w0, const EdgeVector& w1,
                                const EdgeVector& w2, const EdgeVector& w3) {
  switch (type) {
    case TetType::kType0:
      return EdgeVectors{w1 - w0, w2 - w1, w3 - w2};
    case TetType::kType1:
      return EdgeVectors{w1 - w0, w2 - w1, (w3 - w0) + (w3 - w2)};
    default:
      return EdgeVectors{w1 - w0, (w2 - w0) + (w2 - w1), (w3 - w2) + (w3 - w2)};
  }
}

/// An edge vector's component in units of h, +-g 2^size, within +-kStretchLimit: as it is, LSB 2^-27.
/// `clamped` collects a non-zero bit when it was beyond.
inline Position stretch_of(Position g, uint32_t size, bool negative, uint32_t& clamped) {
  const int32_t limit = (int32_t{kStretchLimit} << Position::kFractionBits) >> size;
  const int32_t raw = g.raw();
  const int32_t low = raw < -limit ? -limit : raw;
  const int32_t within = low > limit ? limit : low;
  clamped |= static_cast<uint32_t>(within ^ raw);
  const int32_t scaled = static_cast<int32_t>(static_cast<uint32_t>(within) << size);
  return Position::from_raw(negative ? -scaled : scaled);
}

/// The gradient of the map from rest to `edges`, LSB 2^-27: F itself, or R^T F when the edges are in a
/// rotated frame. 9 clamped shifts, no multiply.
inline Matrix3<Position> gradient_of(const EdgeVectors& edges, Axes axes, uint8_t level, uint32_t& clamped) {
  const uint32_t size = size_of_level(level);
  Matrix3<Position> f;
  const auto set_column = [&](uint32_t k, const EdgeVector& g) {
    const auto column = static_cast<Eigen::Index>(axes.axis(k));
    const bool negative = axes.is_negative(k);
    f(0, column) = stretch_of(g[0], size, negative, clamped);
    f(1, column) = stretch_of(g[1], size, negative, clamped);
    f(2, column) = stretch_of(g[2], size, negative, clamped);
  };
  set_column(0, edges.g1);
  set_column(1, edges.g2);
  set_column(2, edges.g3);
  return f;
}

/// F of a tet with these axes at this level, rounded to Stretch.
inline DeformationGradient deformation_gradient(const EdgeVectors& edges, Axes axes, uint8_t level,
                                                uint32_t& clamped) {
  static_assert(Position::kFractionBits == Stretch::kFractionBits + 1, "one bit is dropped");
  return DeformationGradient(gradient_of(edges, axes, level, clamped).unaryExpr([](Position entry) {
    return Stretch::from_raw((entry.raw() >> 1) + (entry.raw() & 1));
  }));
}

}  // namespace palpate
