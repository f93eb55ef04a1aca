#include "reference/elastic_model.hpp"

#include <Eigen/Eigenvalues>

#include "reference/polar_rotation.hpp"

namespace palpate::reference {
namespace {

Matrix green_strain(const Matrix& f) { return 0.5 * (f.transpose() * f - Matrix::Identity()); }

Matrix small_strain(const Matrix& f) { return 0.5 * (f + f.transpose()) - Matrix::Identity(); }

Matrix stress_of_strain(const Matrix& e, const Material& material) {
  return 2 * material.mu * e + material.lambda * e.trace() * Matrix::Identity();
}

double energy_of_strain(const Matrix& e, const Material& material) {
  return material.mu * e.squaredNorm() + 0.5 * material.lambda * e.trace() * e.trace();
}

/// dP = dF S + F (2 mu dE + lambda tr(dE) I), dE = sym(F^T dF).
Matrix st_venant_kirchhoff_change(const Matrix& f, const Matrix& df, const Material& material) {
  const Matrix product = f.transpose() * df;
  return df * stress_of_strain(green_strain(f), material) +
         f * stress_of_strain(0.5 * (product + product.transpose()), material);
}

template <class Change>
StressTangent tangent_by_columns(Change change) {
  StressTangent tangent;
  for (uint32_t k = 0; k < 9; ++k) {
    Matrix df = Matrix::Zero();
    df(k % 3, k / 3) = 1.0;
    const Matrix dp = change(df);
    tangent.col(k) = Eigen::Map<const Eigen::Matrix<double, 9, 1>>(dp.data());
  }
  return tangent;
}

StressTangent exact_tangent(ElasticModel model, const Matrix& f, const Material& material) {
  switch (model) {
    case ElasticModel::kStVenantKirchhoff:
      return tangent_by_columns(
          [&](const Matrix& df) { return st_venant_kirchhoff_change(f, df, material); });
    case ElasticModel::kLinear:
      return tangent_by_columns(
          [&](const Matrix& df) { return stress_of_strain(0.5 * (df + df.transpose()), material); });
    default:
      return corotated_tangent(f, material);
  }
}

StressTangent without_negative_eigenvalues(const StressTangent& tangent) {
  const StressTangent symmetric = 0.5 * (tangent + tangent.transpose());
  const Eigen::SelfAdjointEigenSolver<StressTangent> solver(symmetric);
  const Eigen::Matrix<double, 9, 1> cut = solver.eigenvalues().cwiseMax(0.0);
  return solver.eigenvectors() * cut.asDiagonal() * solver.eigenvectors().transpose();
}

}  // namespace

Matrix stress_of(ElasticModel model, const Matrix& f, const Material& material) {
  switch (model) {
    case ElasticModel::kStVenantKirchhoff:
      return f * stress_of_strain(green_strain(f), material);
    case ElasticModel::kLinear:
      return stress_of_strain(small_strain(f), material);
    default:
      return corotated_stress(f, polar_rotation(f), material);
  }
}

double energy_of(ElasticModel model, const Matrix& f, const Material& material) {
  switch (model) {
    case ElasticModel::kStVenantKirchhoff:
      return energy_of_strain(green_strain(f), material);
    case ElasticModel::kLinear:
      return energy_of_strain(small_strain(f), material);
    default:
      return corotated_energy(f, material);
  }
}

StressTangent stress_tangent_of(ElasticModel model, const Matrix& f, const Material& material, Tangent kind) {
  const StressTangent exact = exact_tangent(model, f, material);
  return kind == Tangent::kExact ? exact : without_negative_eigenvalues(exact);
}

}  // namespace palpate::reference
