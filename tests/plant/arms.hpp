// Arms for the tests, and postures to try them in.
#pragma once

#include <cmath>
#include <sstream>
#include <string>

#include "plant/arm_dynamics.hpp"
#include "support/random.hpp"

namespace palpate::test {

inline constexpr double kForEver = 1e9;
inline constexpr plant::JointLimits kNoLimits{
    {-kForEver, kForEver}, {-kForEver, kForEver}, {-kForEver, kForEver}, {-kForEver, kForEver}};

/// Of the tests, in seconds.
inline constexpr double kSubstep = 1e-4;
inline const Eigen::Vector3d kNoTorque = Eigen::Vector3d::Zero();

/// No friction; stops as given.
inline plant::ArmParameters frictionless_arm() {
  plant::ArmParameters arm;
  arm.friction.viscous = 0.0;
  arm.friction.coulomb = 0.0;
  return arm;
}

inline plant::ArmParameters frictionless_arm_without_stops() {
  plant::ArmParameters arm = frictionless_arm();
  arm.stops.limits = kNoLimits;
  return arm;
}

/// For a test's record: std::to_string would show small numbers as 0.
inline std::string written(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

/// Evenly within the limits of the three joints; the fold's are met by rejection.
inline Eigen::Vector3d random_posture(Random& random, const plant::JointLimits& limits) {
  const Eigen::Vector3d low(limits.q1.low, limits.q2.low, std::fmax(limits.q3.low, -4.0));
  const Eigen::Vector3d high(limits.q1.high, limits.q2.high, std::fmin(limits.q3.high, 4.0));
  for (;;) {
    const Eigen::Vector3d unit = 0.5 * (random.vector() + Eigen::Vector3d::Ones());
    Eigen::Vector3d q = low + unit.cwiseProduct(high - low);
    if (plant::margin_to_limits(limits, q) >= 0.0) return q;
  }
}

/// Central difference of fourth order of a function of three angles along one of them.
template <class Result, class Function>
Result slope_along(Function function, const Eigen::Vector3d& at, Eigen::Index axis, double step) {
  const auto difference = [&](double distance) -> Result {
    Eigen::Vector3d ahead = at;
    Eigen::Vector3d behind = at;
    ahead[axis] += distance;
    behind[axis] -= distance;
    return (function(ahead) - function(behind)) / (2.0 * distance);
  };
  return (4.0 * difference(step) - difference(2.0 * step)) / 3.0;
}

}  // namespace palpate::test
