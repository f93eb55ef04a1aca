#include "plant/omni.hpp"

#include "model/units.hpp"

namespace palpate::plant::omni {
namespace {

double origin_up() { return sim::to_double(phantom::omni::kOriginUp); }
double origin_forward() { return sim::to_double(phantom::omni::kOriginForward); }

/// From the arm's axes (forward, left, up) to the device's (right, up, to the user).
Eigen::Matrix3d device_axes() {
  Eigen::Matrix3d axes;
  axes << 0, -1, 0, 0, 0, 1, 1, 0, 0;
  return axes;
}

Eigen::Vector3d joints_crossing() { return {0, origin_up(), -origin_forward()}; }

}  // namespace

Links links() {
  return {sim::to_double(phantom::omni::kArm.upper), sim::to_double(phantom::omni::kArm.fore)};
}

std::vector<Figure> doubtful_figures() {
  const auto figures = {kPeakForce,     kContinuousForce, kLinkLength,    kOriginUp, kOriginForward,
                        kWaistLimit,    kShoulderLow,     kShoulderHigh,  kElbowLow, kElbowHigh,
                        kCountsPerTurn, kInkwellUp,       kInkwellForward};
  std::vector<FigureInUse> used;
  used.reserve(figures.size());
  for (const Figure& figure : figures) used.push_back({figure, figure.value});
  return doubtful(used);
}

Eigen::Vector3d tool_position(const Eigen::Vector3d& q) {
  return device_axes() * arm_position(links(), q) + joints_crossing();
}

Eigen::Matrix3d jacobian(const Eigen::Vector3d& q) { return device_axes() * arm_jacobian(links(), q); }

std::optional<Eigen::Vector3d> inverse_kinematics(const Eigen::Vector3d& position) {
  return arm_inverse(links(), device_axes().transpose() * (position - joints_crossing()));
}

Eigen::Vector3d within_peak_force(const Eigen::Vector3d& force) {
  const double size = force.norm();
  if (size <= kPeakForce.value) return force;
  return force * (kPeakForce.value / size);
}

bool is_continuous(const Eigen::Vector3d& force) { return force.norm() <= kContinuousForce.value; }

}  // namespace palpate::plant::omni
