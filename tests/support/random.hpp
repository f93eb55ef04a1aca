// The plant's random numbers, made into what tests draw: the same on every machine, for long seeded
// sequences.
#pragma once

#include <Eigen/Dense>

#include "plant/noise.hpp"

namespace palpate::test {

class Random : public plant::Noise {
 public:
  using Noise::Noise;

  /// 0 .. count - 1
  uint32_t below(uint32_t count) { return static_cast<uint32_t>((bits() >> 32) * count >> 32); }
  /// [-1, 1)
  double centred() { return std::ldexp(static_cast<double>(bits() >> 11), -52) - 1.0; }

  /// One number after the other: the order in which a call evaluates its arguments is the compiler's.
  Eigen::Vector3d vector() {
    Eigen::Vector3d v;
    for (int i = 0; i < 3; ++i) v[i] = centred();
    return v;
  }
  Eigen::Matrix3d matrix() {
    Eigen::Matrix3d m;
    for (int i = 0; i < 9; ++i) m.data()[i] = centred();
    return m;
  }
  /// Coordinates in [low, high).
  Eigen::Vector3d between(double low, double high) {
    return Eigen::Vector3d::Constant(0.5 * (low + high)) + 0.5 * (high - low) * vector();
  }
  Eigen::Vector3d direction() {
    Eigen::Vector3d v = vector();
    while (v.norm() < 0.1 || v.norm() > 1.0) v = vector();
    return v.normalized();
  }
  Eigen::Matrix3d rotation() {
    Eigen::Quaterniond q(0, 0, 0, 0);
    while (q.norm() < 0.1 || q.norm() > 1.0) {
      for (int i = 0; i < 4; ++i) q.coeffs()[i] = centred();
    }
    return q.normalized().toRotationMatrix();
  }
};

}  // namespace palpate::test
