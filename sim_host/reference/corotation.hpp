// The corotated model of core/elastic in doubles: e = sym(R^T F) - I, sigma = 2 mu e + lambda tr(e) I, P = R
// sigma, f_i = - V P grad_i. With R the polar rotation of F it has the energy V (mu |e|^2 + lambda/2
// tr(e)^2).
#pragma once

#include "reference/mesh.hpp"

namespace palpate::reference {

using ElementForces = std::array<Vector, 4>;
/// d vec(P) / d vec(F), columns stacked.
using StressTangent = Eigen::Matrix<double, 9, 9>;

/// First Piola-Kirchhoff stress with a given rotation, which need not be F's own.
Matrix corotated_stress(const Matrix& f, const Matrix& r, const Material& material);
/// Energy density with the polar rotation.
double corotated_energy(const Matrix& f, const Material& material);

ElementForces forces_of(const Element& element, const Matrix& f, const Matrix& r, const Material& material);

/// Tangent with the polar rotation of f, including the rotation's derivative:
///   dP = 2 mu (dF - dR) + lambda tr(R^T dF) R + lambda tr(e) dR
///   dR = R [omega]x,  (tr(S) I - S) omega = axial vector of R^T dF,  S = R^T F
StressTangent corotated_tangent(const Matrix& f, const Material& material);

}  // namespace palpate::reference
