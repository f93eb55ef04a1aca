// The corotated force of one tet (Tagawa et al., Eq. 2, written with the deformation gradient):
//   A = R^T F,  e = sym(A) - I,  sigma = 2 mu e + lambda tr(e) I,  P = R sigma,  f_i = - V dF/dw_i : P
// R is a group's, not this tet's own, so A is not symmetric and the sym matters. With the edge vectors g_k of
// tet_shape.hpp, V dF/dg_k is a shift, and the nodal forces are differences of three vectors t_k; they sum to
// exactly zero whatever the rounding, so linear momentum is exact.
#pragma once

#include "palpate/elastic/deformation_gradient.hpp"
#include "palpate/elastic/material.hpp"
#include "palpate/elastic/rotation_extraction.hpp"

namespace palpate {

/// sigma / (6 E_ref): clamped to +-kStressLimit, which is 4 E_ref (observed in use: 1.5).
using Stress = Q<5, 26>;
inline constexpr Stress kStressLimit = Stress::ratio(4, 6);
/// The trace of e is clamped to +-4 (observed: 0.07).
inline constexpr Strain kTwiceTraceLimit = Strain::ratio(8, 1);

/// The forces t_k = V P e_k / h that pull at g1, g2, g3.
struct EdgeForces {
  Vector3<Force> t1, t2, t3;
};

/// The symmetric sigma as a full matrix. `clamped` collects a non-zero bit when trace or stress was.
inline Matrix3<Stress> corotated_stress(const Matrix3<Strain>& a, const Material& material,
                                        uint32_t& clamped) {
  constexpr Strain kTwo = Strain::ratio(2, 1);
  const Strain xx = a(0, 0) + a(0, 0) - kTwo;  // twice e
  const Strain yy = a(1, 1) + a(1, 1) - kTwo;
  const Strain zz = a(2, 2) + a(2, 2) - kTwo;
  const Strain xy = a(0, 1) + a(1, 0);
  const Strain xz = a(0, 2) + a(2, 0);
  const Strain yz = a(1, 2) + a(2, 1);
  const Strain trace = xx + yy + zz;
  const Strain trace_within = clamp(trace, -kTwiceTraceLimit, kTwiceTraceLimit);
  clamped |= static_cast<uint32_t>(trace.raw() ^ trace_within.raw());
  const Stress pressure = narrow<Stress>(trace_within * material.bulk);
  const auto limited = [&clamped](Stress sigma) {
    const Stress within = clamp(sigma, -kStressLimit, kStressLimit);
    clamped |= static_cast<uint32_t>(sigma.raw() ^ within.raw());
    return within;
  };
  const auto shear = [&](Strain twice_strain) { return narrow<Stress>(twice_strain * material.shear); };
  Matrix3<Stress> sigma;
  sigma(0, 0) = limited(shear(xx) + pressure);
  sigma(1, 1) = limited(shear(yy) + pressure);
  sigma(2, 2) = limited(shear(zz) + pressure);
  sigma(0, 1) = sigma(1, 0) = limited(shear(xy));
  sigma(0, 2) = sigma(2, 0) = limited(shear(xz));
  sigma(1, 2) = sigma(2, 1) = limited(shear(yz));
  return sigma;
}

/// One component of t_k: P / 2^(2 size + type), rounded.
inline Force edge_force_component(Strain p, uint32_t shift, bool negative) {
  static_assert(Force::kFractionBits == Strain::kFractionBits + 1, "P doubles into force bits");
  const int32_t doubled = 2 * p.raw();
  const int32_t half = static_cast<int32_t>((uint32_t{1} << shift) >> 1);
  const int32_t rounded = (doubled + half) >> shift;
  return Force::from_raw(negative ? -rounded : rounded);
}

/// t1, t2, t3 of a tet whose edge vectors are `edges`, with rotation r.
inline EdgeForces corotated_edge_forces(const EdgeVectors& edges, Axes axes, uint8_t level,
                                        const RotationMatrix& r, const Material& material,
                                        uint32_t& clamped) {
  const DeformationGradient f = deformation_gradient(edges, axes, level, clamped);
  const Matrix3<Stress> sigma = corotated_stress(corotated_gradient(r, f), material, clamped);
  const Matrix3<Strain> p = narrow<Strain>(r * sigma);
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
