// PHANToM Omni (Touch). Device frame: x right, y up, z to the user.
// Form of the kinematics: TUM Ubitrack. Lengths and resolution are not published by the maker; see the flags.
#pragma once

#include "palpate/phantom/arm.hpp"

namespace palpate::phantom::omni {

/// False: lengths from memory. They reproduce the pose (0, -110, -35) mm that uncalibrated devices report.
inline constexpr bool kLengthsVerified = false;
/// False: no source gives the encoders' resolution or direction. 19227 counts a joint turn are the 3060
/// counts/rad that the published 0.055 mm need at the least. A program that uses them says so.
inline constexpr bool kCountsPerRadianVerified = false;
/// False: the tool at (0, -65.5, -88.1) mm with the stylus in its inkwell is from memory.
inline constexpr bool kInkwellVerified = false;

inline constexpr ArmLengths kArm{Length::ratio(13335, 100000), Length::ratio(13335, 100000)};
/// The origin lies in the middle of the workspace (q2 = 42.5, q3 = 31.7 degrees), off the joints' crossing.
inline constexpr auto kOriginUp = Metre::ratio(2335, 100000);        ///< L3
inline constexpr auto kOriginForward = Metre::ratio(16835, 100000);  ///< L4

inline constexpr EncoderRatings kEncoders{{19227000, 19227000, 19227000}, {1, 1, 1}};

/// Calibrated with the links orthogonal.
inline constexpr Calibration kPlaceholder =
    make_calibration(kEncoders, {Angle::from_raw(0), Angle::from_raw(0), Angle::from_raw(0)});

/// Calibrated with the stylus in its inkwell, which holds the arm at q = (0, 15.41, -21.25) degrees: counts
/// are those since there (counts_since).
inline constexpr Calibration kInkwell = make_calibration(
    kEncoders, {Angle::from_raw(0), Angle::of_turn(42795, 1000000), Angle::of_turn(-59017, 1000000)});

/// Sines, cosines and levers at these angles. 34 multiplies.
Posture posture(const JointAngles& angles);

/// (x, y, z) = (-R sin q1, h + L3, R cos q1 - L4), see arm.hpp. Within 1.6 nm of the exact position.
/// 2 multiplies.
Vector3<Metre> tool_position(const Posture& posture);

/// tau = J^T F for a force on the device frame's axes. Within 4e-8 N m of the exact product. 9 multiplies.
Vector3<NewtonMetre> joint_torques(const Posture& posture, const Vector3<Newton>& force);

}  // namespace palpate::phantom::omni
