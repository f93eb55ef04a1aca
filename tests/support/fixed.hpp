// Between Eigen's doubles and the core's vectors and matrices of Q.
#pragma once

#include <Eigen/Dense>

#include "palpate/elastic/rotation_extraction.hpp"
#include "palpate/mesh/node_state.hpp"
#include "units.hpp"

namespace palpate::test {

inline constexpr double kForceLsb = 1.0 / (1 << Force::kFractionBits);

template <class To>
Matrix3<To> fixed_matrix(const Eigen::Matrix3d& m) {
  Matrix3<To> fixed;
  for (int i = 0; i < 9; ++i) fixed.data()[i] = sim::to_fixed<To>(m.data()[i]);
  return fixed;
}

template <class To>
Vector3<To> fixed_vector(const Eigen::Vector3d& v) {
  return Vector3<To>(sim::to_fixed<To>(v[0]), sim::to_fixed<To>(v[1]), sim::to_fixed<To>(v[2]));
}

template <class Scalar>
Eigen::Matrix3d doubles(const Matrix3<Scalar>& m) {
  Eigen::Matrix3d out;
  for (int i = 0; i < 9; ++i) out.data()[i] = sim::to_double(m.data()[i]);
  return out;
}

template <class Scalar>
Eigen::Vector3d doubles(const Vector3<Scalar>& v) {
  return Eigen::Vector3d(sim::to_double(v[0]), sim::to_double(v[1]), sim::to_double(v[2]));
}

inline Eigen::Quaterniond doubles(const Quaternion& q) {
  return Eigen::Quaterniond(sim::to_double(q.w), sim::to_double(q.x), sim::to_double(q.y),
                            sim::to_double(q.z));
}

inline Quaternion fixed_quaternion(const Eigen::Matrix3d& r) {
  const Eigen::Quaterniond q(r);
  const auto entry = [](double value) { return sim::to_fixed<RotationEntry>(value); };
  return Quaternion{entry(q.w()), entry(q.x()), entry(q.y()), entry(q.z())};
}

/// How far |q|^2 is from 1, in LSB of 2^-30.
inline double norm_error(const Quaternion& q) {
  return std::abs(std::ldexp(doubles(q).squaredNorm() - 1.0, 30));
}

}  // namespace palpate::test
