// Rotation extraction: the rotation R nearest to a deformation gradient, det R = +1 also for inverted tets.
//
// R maximises tr(R^T F) (polar decomposition). One Newton step from a warm start, with a Cayley update that
// keeps the quaternion a rotation (after Kugelstadt, Koschier, Bender 2018, "Fast corotated FEM using
// operator splitting"):
//   B = R^T F,  a = axial vector of B - B^T,  H = tr(B) I - sym(B),  omega = H^-1 a,  q <- q (1, omega / 2) /
//   |.|
// The error falls with the cube of the warm start's. Where H is not safely positive definite (a tet that is
// flat or inverted in two ways at once) the step is a gradient step, which always climbs and stays finite.
#pragma once

#include "palpate/mesh/deformation_gradient.hpp"
#include "palpate/numeric/rotation.hpp"

namespace palpate {

/// Entries of R^T F while a rotation is extracted: +-128, LSB 2^-24.
using Corotated = Q<7, 24>;

/// Takes q one step nearer to F's rotation, below 1 radian a component: about 0.01 deg of error are left
/// after a step of 5 deg, 1e-4 deg after 1 deg. Columns of F may have norms up to 14. Cost: about 130
/// multiplies, no division, no loop.
void extract_rotation(const DeformationGradient& f, Quaternion& q);

}  // namespace palpate
