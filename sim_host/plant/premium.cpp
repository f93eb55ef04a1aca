#include "plant/premium.hpp"

#include "model/units.hpp"

namespace palpate::plant::premium {

Links links() {
  return {sim::to_double(phantom::premium::kArm.upper), sim::to_double(phantom::premium::kArm.fore)};
}

Eigen::Vector3d tool_position(const Eigen::Vector3d& q) { return arm_position(links(), q); }

Eigen::Matrix3d jacobian(const Eigen::Vector3d& q) { return arm_jacobian(links(), q); }

std::optional<Eigen::Vector3d> inverse_kinematics(const Eigen::Vector3d& position) {
  return arm_inverse(links(), position);
}

}  // namespace palpate::plant::premium
