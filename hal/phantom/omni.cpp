#include "palpate/phantom/omni.hpp"

namespace palpate::phantom::omni {

Posture posture(const JointAngles& angles) { return arm_posture(kArm, angles); }

Vector3<Metre> tool_position(const Posture& posture) {
  const auto [forward, left, up] = arm_position(posture);
  return {-left, up + kOriginUp, forward - kOriginForward};
}

Vector3<NewtonMetre> joint_torques(const Posture& posture, const Vector3<Newton>& force) {
  // -16 N has no opposite in its format: the lowest force becomes the one above it.
  const Newton right = clamp(force.x(), -Newton::max(), Newton::max());
  return arm_torques(posture, {force.z(), -right, force.y()});
}

}  // namespace palpate::phantom::omni
