// The PHANToM Premium 1.5's geometry in double precision. Device frame, in m: x forward, y left, z up; the
// zero pose (links orthogonal) is P = (l1, 0, -l2). Link lengths and encoder figures are hal/phantom's
// integers.
#pragma once

#include "palpate/phantom/premium.hpp"
#include "plant/arm.hpp"
#include "plant/encoders.hpp"
#include "plant/units.hpp"

namespace palpate::plant::premium {

/// l1 = 0.215, l2 = 0.170 m (published), in hal/phantom's rounding: within 2^-34 m.
Links links();

/// Published limits of the joints: +-90, -124 .. 119, -29 .. 214 degrees, q2 - q3 <= 65, q3 - q2 <= 55.
inline constexpr JointLimits kLimits{{radians(-90), radians(90)},
                                     {radians(-124), radians(119)},
                                     {radians(-29), radians(214)},
                                     {radians(-55), radians(65)}};

/// HEDM-5500 on the motors: 4096 counts a motor turn, capstan ratios 13.3, 11.2, 11.2, all reversed.
inline constexpr const phantom::EncoderRatings& kEncoders = phantom::premium::kEncoders;

Eigen::Vector3d tool_position(const Eigen::Vector3d& q);
Eigen::Matrix3d jacobian(const Eigen::Vector3d& q);

/// Nothing when the links do not reach. It does not look at the joints' limits: margin_to_limits does.
std::optional<Eigen::Vector3d> inverse_kinematics(const Eigen::Vector3d& position);

}  // namespace palpate::plant::premium
