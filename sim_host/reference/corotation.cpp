#include "reference/corotation.hpp"

#include <Eigen/Eigenvalues>

#include "reference/polar_rotation.hpp"

namespace palpate::reference {
namespace {

using StressTangent = Eigen::Matrix<double, 9, 9>;  // d vec(P) / d vec(F), columns stacked

StressTangent stress_tangent(const Matrix& f, const Material& material) {
  const Matrix r = polar_rotation(f);
  const Matrix s = r.transpose() * f;
  const Matrix h_inverse = (s.trace() * Matrix::Identity() - 0.5 * (s + s.transpose())).inverse();
  const double trace_e = s.trace() - 3.0;
  StressTangent tangent;
  for (uint32_t k = 0; k < 9; ++k) {
    Matrix df = Matrix::Zero();
    df(k % 3, k / 3) = 1.0;
    const Matrix rotated = r.transpose() * df;
    const Matrix dr = r * cross_matrix(h_inverse * axial_vector(rotated));
    const Matrix dp =
        2 * material.mu * (df - dr) + material.lambda * rotated.trace() * r + material.lambda * trace_e * dr;
    tangent.col(k) = Eigen::Map<const Eigen::Matrix<double, 9, 1>>(dp.data());
  }
  return tangent;
}

void cut_negative_eigenvalues(StressTangent& tangent) {
  const StressTangent symmetric = 0.5 * (tangent + tangent.transpose());
  const Eigen::SelfAdjointEigenSolver<StressTangent> solver(symmetric);
  const Eigen::Matrix<double, 9, 1> cut = solver.eigenvalues().cwiseMax(0.0);
  tangent = solver.eigenvectors() * cut.asDiagonal() * solver.eigenvectors().transpose();
}

}  // namespace

Matrix corotated_stress(const Matrix& f, const Matrix& r, const Material& material) {
  const Matrix a = r.transpose() * f;
  const Matrix e = 0.5 * (a + a.transpose()) - Matrix::Identity();
  return r * (2 * material.mu * e + material.lambda * e.trace() * Matrix::Identity());
}

double corotated_energy(const Matrix& f, const Material& material) {
  const Matrix a = polar_rotation(f).transpose() * f;
  const Matrix e = 0.5 * (a + a.transpose()) - Matrix::Identity();
  return material.mu * e.squaredNorm() + 0.5 * material.lambda * e.trace() * e.trace();
}

ElementForces forces_of(const Element& element, const Matrix& f, const Matrix& r, const Material& material) {
  const Matrix p = corotated_stress(f, r, material);
  ElementForces forces;
  for (uint32_t i = 0; i < 4; ++i) forces[i] = -element.volume * (p * element.gradient[i]);
  return forces;
}

ElementTangent tangent_of(const Element& element, const Matrix& f, const Material& material, Tangent kind) {
  StressTangent stress = stress_tangent(f, material);
  if (kind == Tangent::kPositive) cut_negative_eigenvalues(stress);
  Eigen::Matrix<double, 9, 12> df_dx = Eigen::Matrix<double, 9, 12>::Zero();
  for (uint32_t node = 0; node < 4; ++node) {
    for (uint32_t axis = 0; axis < 3; ++axis) {
      for (uint32_t column = 0; column < 3; ++column) {
        df_dx(3 * column + axis, 3 * node + axis) = element.gradient[node][column];
      }
    }
  }
  return element.volume * df_dx.transpose() * stress * df_dx;
}

}  // namespace palpate::reference
