// The corotated force of one tet (Tagawa et al., Eq. 2, written with the deformation gradient):
//   A = R^T F,  e = sym(A) - I,  sigma = 2 mu e + lambda tr(e) I,  P = R sigma,  f_i = - V dF/dw_i : P
// R is a group's, not this tet's own, so A is not symmetric and the sym matters. With the edge vectors g_k of
// tet_shape.hpp, V dF/dg_k is a shift, and the nodal forces are differences of three vectors t_k; they sum to
// exactly zero whatever the rounding, so linear momentum is exact.
//
// The cycle evaluates this in its group's frame (group_forces.hpp), where A needs no product and P = sigma.
// corotated_edge_forces is the same tet by tet: what the tests compare it with.
#pragma once

#include "palpate/elastic/material.hpp"
#include "palpate/mesh/deformation_gradient.hpp"
#include "palpate/numeric/rotation.hpp"

namespace palpate {

/// Entries of A and of twice e. |A| <= kStretchLimit, so twice e stays within 10.
using Strain = Q<4, 27>;
/// sigma / (6 E_ref): clamped to +-kStressLimit, which is 3 E_ref (observed in use: 1.5).
using Stress = Q<5, 26>;
inline constexpr Stress kStressLimit = Stress::ratio(1, 2);
/// The trace of e is clamped to just below 2 (observed: 0.07).
using Trace = Q<1, 30>;
inline constexpr Strain kTraceLimit = Strain::from_raw((int32_t{2} << Strain::kFractionBits) - 1);

/// The forces t_k = V P e_k / h that pull at g1, g2, g3.
struct EdgeForces {
  Vector3<Force> t1, t2, t3;
};

/// lambda tr(e), from A.
PALPATE_ALWAYS_INLINE Stress pressure(const Matrix3<Strain>& a, const Material& material, uint32_t& clamped) {
  const Strain trace = a(0, 0) + a(1, 1) + a(2, 2) - Strain::ratio(3, 1);
  const Strain within = clamp(trace, -kTraceLimit, kTraceLimit);
  clamped |= static_cast<uint32_t>(trace.raw() ^ within.raw());
  constexpr int kShift = Trace::kFractionBits - Strain::kFractionBits;
  return narrow<Stress>(Trace::from_raw(within.raw() * (1 << kShift)) * material.bulk);
}

/// The symmetric sigma as a full matrix. `clamped` collects a non-zero bit when trace or stress was. 7
/// multiplies.
PALPATE_ALWAYS_INLINE Matrix3<Stress> corotated_stress(const Matrix3<Strain>& a, const Material& material,
                                                       uint32_t& clamped) {
  const Stress p = pressure(a, material, clamped);
  const auto limited = [&clamped](Stress sigma) {
    const Stress within = clamp(sigma, -kStressLimit, kStressLimit);
    clamped |= static_cast<uint32_t>(sigma.raw() ^ within.raw());
    return within;
  };
  const auto normal = [&](Strain stretch) {
    const Strain twice_strain = stretch + stretch - Strain::ratio(2, 1);
    return limited(narrow<Stress>(twice_strain * material.shear) + p);
  };
  const auto tangential = [&](Strain b, Strain c) {
    return limited(narrow<Stress>((b + c) * material.shear));
  };
  Matrix3<Stress> sigma;
  sigma(0, 0) = normal(a(0, 0));
  sigma(1, 1) = normal(a(1, 1));
  sigma(2, 2) = normal(a(2, 2));
  sigma(0, 1) = sigma(1, 0) = tangential(a(0, 1), a(1, 0));
  sigma(0, 2) = sigma(2, 0) = tangential(a(0, 2), a(2, 0));
  sigma(1, 2) = sigma(2, 1) = tangential(a(1, 2), a(2, 1));
  return sigma;
}

/// One component of t_k: P / 2^(2 size + type), rounded.
inline Force edge_force_component(Stress p, uint32_t shift, bool negative) {
  static_assert(Stress::kFractionBits == Force::kFractionBits + 1, "one bit is dropped");
  const int32_t half = static_cast<int32_t>(uint32_t{1} << shift);
  const int32_t rounded = (p.raw() + half) >> (shift + 1);
  return Force::from_raw(negative ? -rounded : rounded);
}

/// t1, t2, t3 from P.
inline EdgeForces edge_forces(const Matrix3<Stress>& p, Axes axes, uint8_t level) {
  const uint32_t shift = 2u * size_of_level(level) + static_cast<uint32_t>(type_of_level(level));
  const auto column = [&](uint32_t k) {
    const auto axis = static_cast<Eigen::Index>(axes.axis(k));
    const bool negative = axes.is_negative(k);
    return Vector3<Force>(edge_force_component(p(0, axis), shift, negative),
                          edge_force_component(p(1, axis), shift, negative),
                          edge_force_component(p(2, axis), shift, negative));
  };
  return EdgeForces{column(0), column(1), column(2)};
}

/// A = R^T F, entries within kStretchLimit as in the cycle. 27 multiplies.
inline Matrix3<Strain> corotated_gradient(const RotationMatrix& r, const DeformationGradient& f,
                                          uint32_t& clamped) {
  constexpr Strain kLimit = Strain::ratio(kStretchLimit, 1);
  Matrix3<Strain> a = narrow<Strain>(r.transpose() * f);
  for (const uint32_t i : bounded<9>(9, [] {})) {
    const Strain within = clamp(a.data()[i], -kLimit, kLimit);
    clamped |= static_cast<uint32_t>(a.data()[i].raw() ^ within.raw());
    a.data()[i] = within;
  }
  return a;
}

/// t1, t2, t3 of a tet whose edge vectors are `edges`, with rotation r.
inline EdgeForces corotated_edge_forces(const EdgeVectors& edges, Axes axes, uint8_t level,
                                        const RotationMatrix& r, const Material& material,
                                        uint32_t& clamped) {
  const DeformationGradient f = deformation_gradient(edges, axes, level, clamped);
  const Matrix3<Strain> a = corotated_gradient(r, f, clamped);
  const Matrix3<Stress> sigma = corotated_stress(a, material, clamped);
  return edge_forces(narrow<Stress>(r * sigma), axes, level);
}

/// Adds f_i = - sum over k of dg_k/dw_i t_k to the four nodes.
inline void add_nodal_forces(TetType type, const EdgeForces& t, Vector3<Force>& f0, Vector3<Force>& f1,
                             Vector3<Force>& f2, Vector3<Force>& f3) {
  switch (type) {
    case TetType::kType0:
      f0 += t.t1;
      f1 += t.t2 - t.t1;
      f2 += t.t3 - t.t2;
      f3 -= t.t3;
      break;
    case TetType::kType1:
      f0 += t.t1 + t.t3;
      f1 += t.t2 - t.t1;
      f2 += t.t3 - t.t2;
      f3 -= t.t3 + t.t3;
      break;
    default:
      f0 += t.t1 + t.t2;
      f1 += t.t2 - t.t1;
      f2 += (t.t3 - t.t2) + (t.t3 - t.t2);
      f3 -= t.t3 + t.t3;
      break;
  }
}

}  // namespace palpate
