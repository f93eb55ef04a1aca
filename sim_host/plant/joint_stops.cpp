#include "plant/joint_stops.hpp"

#include <algorithm>

namespace palpate::plant {
namespace {

/// Above 0 in the upper stop, below 0 in the lower one.
double depth_beyond(const Range& range, double angle) {
  return std::max(0.0, angle - range.high) + std::min(0.0, angle - range.low);
}

double stop_torque(const JointStops& stops, const Range& range, double angle, double rate) {
  const double depth = depth_beyond(range, angle);
  if (depth == 0.0) return 0.0;
  const double torque = -stops.stiffness * depth - stops.damping * rate;
  return depth > 0.0 ? std::min(0.0, torque) : std::max(0.0, torque);
}

}  // namespace

Eigen::Vector3d JointStops::torques(const Eigen::Vector3d& q, const Eigen::Vector3d& rates) const {
  const double fold = stop_torque(*this, limits.fold, q[1] - q[2], rates[1] - rates[2]);
  return {stop_torque(*this, limits.q1, q[0], rates[0]), stop_torque(*this, limits.q2, q[1], rates[1]) + fold,
          stop_torque(*this, limits.q3, q[2], rates[2]) - fold};
}

double JointStops::energy(const Eigen::Vector3d& q) const {
  const auto square = [](double x) { return x * x; };
  return 0.5 * stiffness *
         (square(depth_beyond(limits.q1, q[0])) + square(depth_beyond(limits.q2, q[1])) +
          square(depth_beyond(limits.q3, q[2])) + square(depth_beyond(limits.fold, q[1] - q[2])));
}

}  // namespace palpate::plant
