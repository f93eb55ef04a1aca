// The PHANToMs' kinematics in double precision, written out from the published equations and kept apart from
// the code under test: each device has its own position and Jacobian here.
#pragma once

#include <array>
#include <cmath>

#include "palpate/phantom/arm.hpp"
#include "sweep.hpp"

namespace palpate::test {

using Triple = std::array<double, 3>;
using Square = std::array<Triple, 3>;

inline constexpr double kPi = 3.14159265358979323846;

inline double degrees(double angle) { return angle * kPi / 180; }

/// The nearest Angle, and what it stands for: errors are measured at the angles the device really has.
inline Angle to_angle(double radians) {
  return Angle::from_raw(
      static_cast<int32_t>(static_cast<uint32_t>(std::llround(std::ldexp(radians / (2 * kPi), 32)))));
}
inline double to_radians(Angle angle) { return std::ldexp(2 * kPi * angle.raw(), -32); }
inline phantom::JointAngles to_angles(const Triple& q) {
  return {to_angle(q[0]), to_angle(q[1]), to_angle(q[2])};
}
inline Triple to_radians(const phantom::JointAngles& q) {
  return {to_radians(q.q1), to_radians(q.q2), to_radians(q.q3)};
}
inline Triple difference(const Triple& a, const Triple& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline double dot(const Triple& a, const Triple& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline double norm(const Triple& a) { return std::sqrt(dot(a, a)); }

template <class Scalar>
Triple to_triple(const Vector3<Scalar>& v) {
  return {to_double(v.x()), to_double(v.y()), to_double(v.z())};
}
inline Vector3<phantom::Newton> to_force(const Triple& newtons) {
  const auto one = [](double f) {
    return phantom::Newton::from_raw(
        static_cast<int32_t>(std::llround(std::ldexp(f, phantom::Newton::kFractionBits))));
  };
  return {one(newtons[0]), one(newtons[1]), one(newtons[2])};
}

/// J^T F.
inline Triple transposed_times(const Square& jacobian, const Triple& force) {
  Triple torque{};
  for (std::size_t joint = 0; joint < 3; ++joint) {
    for (std::size_t row = 0; row < 3; ++row) torque[joint] += jacobian[row][joint] * force[row];
  }
  return torque;
}

/// The largest difference between J's columns and central differences of the position.
template <class Position>
double difference_from_finite_differences(const Square& jacobian, const Triple& q, Position position) {
  constexpr double kStep = 1e-6;
  double worst = 0;
  for (std::size_t joint = 0; joint < 3; ++joint) {
    Triple ahead = q;
    Triple behind = q;
    ahead[joint] += kStep;
    behind[joint] -= kStep;
    const Triple change = difference(position(ahead), position(behind));
    for (std::size_t row = 0; row < 3; ++row) {
      worst = std::fmax(worst, std::fabs(change[row] / (2 * kStep) - jacobian[row][joint]));
    }
  }
  return worst;
}

/// visit(q) over a grid of a device's joint range; limits are {low, high} of q1, q2, q3, and steps a side.
template <class Reachable, class Visit>
void for_each_posture(const std::array<std::array<double, 2>, 3>& limits, int steps, Reachable reachable,
                      Visit visit) {
  const auto at = [&](std::size_t joint, int step) {
    return limits[joint][0] + (limits[joint][1] - limits[joint][0]) * step / steps;
  };
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= steps; ++j) {
      for (int k = 0; k <= steps; ++k) {
        const Triple q{at(0, i), at(1, j), at(2, k)};
        if (reachable(q)) visit(q);
      }
    }
  }
}

}  // namespace palpate::test
