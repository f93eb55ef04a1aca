// The arm that the PHANToMs share: a turret that turns two links, moved in its plane by a parallelogram. The
// Premium and the Omni differ in link lengths, axis names and origin only.
//
// Arm frame: forward, left, up from the joints' crossing; in the plane of the links
//   reach  R = l1 cos q2 + l2 sin q3        height h = l1 sin q2 - l2 cos q3
//   position (forward, left, up) = (R cos q1, R sin q1, h)
// Source: Cavusoglu, Feygin, Tendick, "A Critical Study of the Mechanical and Electrical Properties of the
// PHANToM Haptic Interface", Presence 11(6), 2002, without the fixed offset to the base.
#pragma once

#include "palpate/numeric/trigonometry.hpp"
#include "palpate/phantom/joint_angles.hpp"
#include "palpate/phantom/units.hpp"

namespace palpate::phantom {

struct ArmLengths {
  Length upper;  ///< l1, turned by q2
  Length fore;   ///< l2, turned by q3
};

/// All that the kinematics need of one set of joint angles; the position and the torques of a tick share it.
struct Posture {
  SineCosine turret;    ///< of q1
  Lever upper_forward;  ///< l1 cos q2
  Lever upper_up;       ///< l1 sin q2
  Lever fore_forward;   ///< l2 sin q3
  Lever fore_down;      ///< l2 cos q3
};

/// Levers within 0.4 nm. 34 multiplies, 30 of them in three sine_cosine.
inline Posture arm_posture(const ArmLengths& lengths, const JointAngles& angles) {
  const SineCosine upper = sine_cosine(angles.q2);
  const SineCosine fore = sine_cosine(angles.q3);
  return {sine_cosine(angles.q1), narrow<Lever>(lengths.upper * upper.cosine),
          narrow<Lever>(lengths.upper * upper.sine), narrow<Lever>(lengths.fore * fore.sine),
          narrow<Lever>(lengths.fore * fore.cosine)};
}

/// A point or a force in the arm frame.
template <class Scalar>
struct ArmVector {
  Scalar forward, left, up;
};

/// Each within 1.3 nm of the exact position at the same angles. 2 multiplies.
inline ArmVector<Metre> arm_position(const Posture& posture) {
  const Lever reach = posture.upper_forward + posture.fore_forward;
  const Lever height = posture.upper_up - posture.fore_down;
  return {narrow<Metre>(reach * posture.turret.cosine), narrow<Metre>(reach * posture.turret.sine),
          narrow<Metre>(widen<Metre::kFractionBits + 1>(height))};
}

/// tau = J^T F with J = d position / d q, written in the plane of the links:
///   f_r = cos q1 F_forward + sin q1 F_left,   f_t = cos q1 F_left - sin q1 F_forward
///   tau1 = R f_t,  tau2 = l1 cos q2 F_up - l1 sin q2 f_r,  tau3 = l2 sin q3 F_up + l2 cos q3 f_r
/// Any force that Newton holds, so that |tau| < 12 N m. Within 4e-8 N m of the exact product at the same
/// angles. 9 multiplies.
inline Vector3<NewtonMetre> arm_torques(const Posture& posture, const ArmVector<Newton>& force) {
  using PlaneForce = Q<5, 26>;  // f_r and f_t reach 16 sqrt 2 N
  const auto& [sine, cosine] = posture.turret;
  const auto radial = narrow<PlaneForce>(cosine * force.forward + sine * force.left);
  const auto tangential = narrow<PlaneForce>(cosine * force.left - sine * force.forward);
  const auto up = narrow<PlaneForce>(widen<Newton::kFractionBits>(force.up));
  const Lever reach = posture.upper_forward + posture.fore_forward;
  return {narrow<NewtonMetre>(reach * tangential),
          narrow<NewtonMetre>(posture.upper_forward * up - posture.upper_up * radial),
          narrow<NewtonMetre>(posture.fore_forward * up + posture.fore_down * radial)};
}

}  // namespace palpate::phantom
