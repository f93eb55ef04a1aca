// PHANToM Premium 1.5. Device frame: x forward, y left, z up.
// The zero pose (links orthogonal) is P = (l1, 0, -l2).
// Figures: Cavusoglu, Feygin, Tendick 2002 and github.com/mahilab/Phantom.
#pragma once

#include "palpate/phantom/arm.hpp"
#include "palpate/phantom/motor_code.hpp"

namespace palpate::phantom::premium {

inline constexpr ArmLengths kArm{Length::ratio(215, 1000), Length::ratio(170, 1000)};

/// HEDM-5500 encoders of 1024 lines on the motors, x4: 4096 counts a motor turn, times the capstan ratios
/// 13.3, 11.2, 11.2. That is 8670, 7301, 7301 counts/rad. All three are reversed: decoders in their natural
/// direction count down as the joint angles grow. A board that reverses them in hardware uses +1, +1, +1.
inline constexpr EncoderRatings kEncoders{{4096 * 13300, 4096 * 11200, 4096 * 11200}, {-1, -1, -1}};

/// Decoders reset with the links orthogonal.
inline constexpr Calibration kPremium15 =
    make_calibration(kEncoders, {Angle::from_raw(0), Angle::from_raw(0), Angle::from_raw(0)});

/// Maxon RE25 118743: Kt 0.0234 N m/A. The current limit is the continuous 1.24 A (1.5 N at the tip), the
/// full scale the motor's stall current of 5.5 A (6.7 N); the latter belongs to the board.
inline constexpr DriveRatings kDriveRatings{{13300, 11200, 11200}, {1, -1, -1}, 23400, 1240, 5500};
inline constexpr Drive kDrive = make_drive(kDriveRatings);

/// Sines, cosines and levers at these angles. 34 multiplies.
Posture posture(const JointAngles& angles);

/// (x, y, z) = (R cos q1, R sin q1, h), see arm.hpp. Within 1.3 nm of the exact position. 2 multiplies.
Vector3<Metre> tool_position(const Posture& posture);

/// tau = J^T F for a force on the device frame's axes. Within 4e-8 N m of the exact product. 9 multiplies.
Vector3<NewtonMetre> joint_torques(const Posture& posture, const Vector3<Newton>& force);

}  // namespace palpate::phantom::premium
