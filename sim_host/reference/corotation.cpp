#include "reference/corotation.hpp"

#include "reference/polar_rotation.hpp"

namespace palpate::reference {

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

StressTangent corotated_tangent(const Matrix& f, const Material& material) {
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

}  // namespace palpate::reference
