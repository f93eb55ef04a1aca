#include "palpate/phantom/premium.hpp"

namespace palpate::phantom::premium {

Posture posture(const JointAngles& angles) { return arm_posture(kArm, angles); }

Vector3<Metre> tool_position(const Posture& posture) {
  const auto [forward, left, up] = arm_position(posture);
  return {forward, left, up};
}

Vector3<NewtonMetre> joint_torques(const Posture& posture, const Vector3<Newton>& force) {
  return arm_torques(posture, {force.x(), force.y(), force.z()});
}

}  // namespace palpate::phantom::premium
