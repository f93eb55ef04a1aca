#include "reference/polar_rotation.hpp"

#include <cmath>

namespace palpate::reference {
namespace {

constexpr int kMostSteps = 30;

bool is_positive_definite(const Matrix& h) {
  return h(0, 0) > 0 && h(0, 0) * h(1, 1) - h(0, 1) * h(1, 0) > 0 && h.determinant() > 0;
}

}  // namespace

Vector axial_vector(const Matrix& m) {
  return Vector(m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1));
}

Matrix cross_matrix(const Vector& a) {
  Matrix m;
  m << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return m;
}

Matrix polar_rotation(const Matrix& f) {
  const Eigen::JacobiSVD<Matrix> svd(f, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1.0 : 1.0;
  return svd.matrixU() * Vector(1.0, 1.0, sign).asDiagonal() * svd.matrixV().transpose();
}

Matrix polar_rotation(const Matrix& f, const Matrix& warm) {
  Eigen::Quaterniond q(warm);
  for (int i = 0; i < kMostSteps; ++i) {
    const Matrix b = q.toRotationMatrix().transpose() * f;
    const Matrix h = b.trace() * Matrix::Identity() - 0.5 * (b + b.transpose());
    if (!is_positive_definite(h)) break;
    const Vector omega = h.inverse() * axial_vector(b);
    if (omega.norm() < 1e-15) return q.toRotationMatrix();
    q = (q * Eigen::Quaterniond(1.0, omega[0] / 2, omega[1] / 2, omega[2] / 2)).normalized();
    if (omega.norm() < 1e-6) return q.toRotationMatrix();  // the next step would be below 1e-17
  }
  return polar_rotation(f);
}

double angle_between(const Matrix& a, const Matrix& b) {
  const Matrix r = a.transpose() * b;
  return std::atan2(axial_vector(r).norm(), r.trace() - 1.0);
}

}  // namespace palpate::reference
