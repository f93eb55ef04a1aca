// The arm that the PHANToMs share, in double precision: a turret (q1) turns two links (q2 and q3, absolute
// angles) in their plane. The fixed-point twin is hal/phantom/palpate/phantom/arm.hpp.
//
// Arm frame: forward, left, up from the joints' crossing, in m; angles in rad, vectors of joints are (q1, q2,
// q3).
//   reach R = l1 cos q2 + l2 sin q3    height h = l1 sin q2 - l2 cos q3    P = (R cos q1, R sin q1, h)
// Source: Cavusoglu, Feygin, Tendick, Presence 11(6), 2002.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace palpate::plant {

struct Links {
  double upper;  ///< l1, turned by q2
  double fore;   ///< l2, turned by q3
};

Eigen::Vector3d arm_position(const Links& links, const Eigen::Vector3d& q);

/// J = dP/dq: tip velocity J q', joint torques of a tip force J^T F. det J = R l1 l2 cos(q2 - q3).
Eigen::Matrix3d arm_jacobian(const Links& links, const Eigen::Vector3d& q);

/// J' q', what is left of the tip's acceleration J q'' + J' q' when q'' = 0. In m/s^2.
Eigen::Vector3d arm_acceleration_at_constant_rates(const Links& links, const Eigen::Vector3d& q,
                                                   const Eigen::Vector3d& rates);

/// The posture with R > 0 and |q2 - q3| < 90 degrees. Nothing when the links do not reach.
///   q1 = atan2(y, x), q2 = acos((l1^2 + d^2 - l2^2) / (2 l1 d)) + atan2(z, r),
///   q3 = acos((l1^2 + l2^2 - d^2) / (2 l1 l2)) + q2 - 90 degrees,    r = hypot(x, y), d = |P|
std::optional<Eigen::Vector3d> arm_inverse(const Links& links, const Eigen::Vector3d& position);

struct Range {
  double low, high;
};

/// Where the joints end, in rad. `fold` is q2 - q3, which the parallelogram limits.
struct JointLimits {
  Range q1, q2, q3, fold;
};

/// How far the nearest limit is, in rad; negative beyond it.
double margin_to_limits(const JointLimits& limits, const Eigen::Vector3d& q);

}  // namespace palpate::plant
