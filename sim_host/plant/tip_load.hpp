#pragma once

#include <Eigen/Core>

namespace palpate::plant {

/// What acts on the tip during one substep, in the device's frame:
///   F = force + stiffness (anchor(t) - P) + damping (anchor' - P') - mass P''
/// with anchor(t) = anchor + anchor_velocity t, t from the substep's start. All SI. All zero is a free tip.
struct TipLoad {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d anchor = Eigen::Vector3d::Zero();
  Eigen::Vector3d anchor_velocity = Eigen::Vector3d::Zero();
  double stiffness = 0.0;
  double damping = 0.0;
  double mass = 0.0;
};

}  // namespace palpate::plant
