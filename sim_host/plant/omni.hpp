// The PHANToM Omni (Touch) in double precision: kinematics, limits, force range. Its dynamics are published
// nowhere, so there is no plant of it. Device frame, in m: x right, y up, z to the user.
//   R = L1 cos q2 + L2 sin q3,  P = (-R sin q1, L1 sin q2 - L2 cos q3 + L3, R cos q1 - L4)
// Source of the form: TUM Ubitrack; of the doubtful figures: see each. Angles in rad, forces in N.
#pragma once

#include "palpate/phantom/omni.hpp"
#include "plant/arm.hpp"
#include "plant/encoders.hpp"
#include "plant/figure.hpp"

namespace palpate::plant::omni {

/// L1 = L2 = 0.13335 m in hal/phantom's rounding; L3 and L4 likewise move the origin to the workspace's
/// middle.
Links links();

inline constexpr Figure kPeakForce{"Omni peak force", 3.3, "N", Mark::kPublished, "maker's data sheet"};
inline constexpr Figure kContinuousForce{"Omni continuous force", 0.88, "N", Mark::kPublished,
                                         "maker's data sheet"};
inline constexpr Figure kLinkLength{
    "Omni L1, L2", 0.13335, "m", Mark::kUnverified,
    "reproduces the uncalibrated pose (0, -110, -35) mm; a URDF has 0.134 and "
    "0.1325"};
inline constexpr Figure kOriginUp{"Omni L3", 0.02335, "m", Mark::kUnverified, "as L1"};
inline constexpr Figure kOriginForward{"Omni L4", 0.16835, "m", Mark::kUnverified, "as L1"};
inline constexpr Figure kWaistLimit{"Omni waist limit", 0.98, "rad", Mark::kUnverified, "from a URDF"};
inline constexpr Figure kShoulderLow{"Omni shoulder's lower limit", 0.0, "rad", Mark::kUnverified,
                                     "from a URDF"};
inline constexpr Figure kShoulderHigh{"Omni shoulder's upper limit", 1.75, "rad", Mark::kUnverified,
                                      "from a URDF"};
inline constexpr Figure kElbowLow{"Omni elbow's lower limit", -0.81, "rad", Mark::kUnverified,
                                  "from a URDF, as q3 - q2"};
inline constexpr Figure kElbowHigh{"Omni elbow's upper limit", 1.25, "rad", Mark::kUnverified,
                                   "from a URDF, as q3 - q2"};
inline constexpr Figure kCountsPerTurn{"Omni encoder counts a joint turn", 19227, "counts", Mark::kAssumed,
                                       "the least that the published 0.055 mm need; directions are assumed "
                                       "too"};

inline constexpr Figure kInkwellUp{"Omni inkwell's y", -0.0655, "m", Mark::kUnverified,
                                   "of the tool in it, from memory; x is 0"};
inline constexpr Figure kInkwellForward{"Omni inkwell's z", -0.0881, "m", Mark::kUnverified, "as y"};

inline constexpr double kUnlimited = 1e9;
inline constexpr JointLimits kLimits{{-kWaistLimit.value, kWaistLimit.value},
                                     {kShoulderLow.value, kShoulderHigh.value},
                                     {-kUnlimited, kUnlimited},
                                     {-kElbowHigh.value, -kElbowLow.value}};

/// A placeholder, see kCountsPerTurn.
inline constexpr const phantom::EncoderRatings& kEncoders = phantom::omni::kEncoders;

/// What a program that uses this device must say, once. The figures can't be replaced, so it is all of them.
std::vector<Figure> doubtful_figures();

Eigen::Vector3d tool_position(const Eigen::Vector3d& q);
/// tau = J^T F.
Eigen::Matrix3d jacobian(const Eigen::Vector3d& q);
/// Nothing when the links do not reach. It does not look at the joints' limits: margin_to_limits does.
std::optional<Eigen::Vector3d> inverse_kinematics(const Eigen::Vector3d& position);

/// The force in the same direction that the device can give: at most kPeakForce.
Eigen::Vector3d within_peak_force(const Eigen::Vector3d& force);

/// Whether the device can hold the force for ever: at most kContinuousForce.
bool is_continuous(const Eigen::Vector3d& force);

}  // namespace palpate::plant::omni
