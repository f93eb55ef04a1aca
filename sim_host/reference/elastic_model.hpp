// The three models that the paper compares, as functions of the deformation gradient F: first Piola-Kirchhoff
// stress P (Pa), energy density psi (J/m3), P = d psi / d F. All have 2 mu e + lambda tr(e) I, in different
// strains:
//   corotation            e = sym(R^T F) - I, R the polar rotation of F    P = R (2 mu e + lambda tr(e) I)
//   St. Venant-Kirchhoff  E = (F^T F - I) / 2, Green's strain              P = F (2 mu E + lambda tr(E) I)
//   linear                e = sym(F) - I                                   P = 2 mu e + lambda tr(e) I
// psi = mu |e|^2 + lambda/2 tr(e)^2. Source: Bonet and Wood, Nonlinear Continuum Mechanics, ch. 5 and 6.
#pragma once

#include "reference/corotation.hpp"

namespace palpate::reference {

enum class ElasticModel { kCorotation, kStVenantKirchhoff, kLinear };

Matrix stress_of(ElasticModel model, const Matrix& f, const Material& material);
double energy_of(ElasticModel model, const Matrix& f, const Material& material);

enum class Tangent { kExact, kPositive };  // kPositive: negative eigenvalues of dP/dF are cut to zero

StressTangent stress_tangent_of(ElasticModel model, const Matrix& f, const Material& material, Tangent kind);

template <uint32_t Nodes>
constexpr int kCoordinatesOf = static_cast<int>(3 * Nodes);
template <uint32_t Nodes>
using TangentOf = Eigen::Matrix<double, kCoordinatesOf<Nodes>, kCoordinatesOf<Nodes>>;
using ElementTangent = TangentOf<4>;

/// - d f / d x of an element's coordinates, node by node, N/m.
template <uint32_t Nodes>
TangentOf<Nodes> tangent_of(const ElementOf<Nodes>& element, const Matrix& f, const Material& material,
                            Tangent kind, ElasticModel model = ElasticModel::kCorotation) {
  using GradientChange = Eigen::Matrix<double, 9, kCoordinatesOf<Nodes>>;
  GradientChange df_dx = GradientChange::Zero();
  for (uint32_t node = 0; node < Nodes; ++node) {
    for (uint32_t axis = 0; axis < 3; ++axis) {
      for (uint32_t column = 0; column < 3; ++column) {
        df_dx(3 * column + axis, 3 * node + axis) = element.gradient[node][column];
      }
    }
  }
  return element.volume * df_dx.transpose() * stress_tangent_of(model, f, material, kind) * df_dx;
}

}  // namespace palpate::reference
