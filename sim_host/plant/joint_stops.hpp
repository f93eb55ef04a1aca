// What ends the joints' ranges: springs with dampers.
#pragma once

#include "plant/premium.hpp"

namespace palpate::plant {

/// At each end of q1, q2, q3 and the fold q2 - q3, with x the depth into the stop: torque k x + b x' against
/// the motion, and never a pull: once the joint leaves faster than the stop follows, there is none. The
/// fold's torque acts on q2 and with the opposite sign on q3. Source of k and b: mahilab/Phantom.
struct JointStops {
  JointLimits limits = premium::kLimits;
  double stiffness = 10.0;  ///< k, N m/rad
  double damping = 0.1;     ///< b, N m s/rad

  [[nodiscard]] Eigen::Vector3d torques(const Eigen::Vector3d& q, const Eigen::Vector3d& rates) const;
  /// In the springs, J.
  [[nodiscard]] double energy(const Eigen::Vector3d& q) const;
};

}  // namespace palpate::plant
