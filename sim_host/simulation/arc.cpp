#include "simulation/arc.hpp"

#include <algorithm>
#include <cmath>

#include "plant/smooth_step.hpp"
#include "units.hpp"

namespace palpate::sim {

namespace {

/// From axis `from` towards axis `to`.
Eigen::Matrix3d turned(Eigen::Index from, Eigen::Index to, double angle) {
  Eigen::Matrix3d r = Eigen::Matrix3d::Identity();
  r(from, from) = r(to, to) = std::cos(angle);
  r(to, from) = std::sin(angle);
  r(from, to) = -std::sin(angle);
  return r;
}

}  // namespace

RigidMotion end_motion(const Scenario& scenario, double part) {
  const auto& cubes = scenario.model.cubes;
  const auto along = std::max_element(cubes.begin(), cubes.end()) - cubes.begin();
  const auto aside = (along + 2) % 3;
  const double length = cubes[static_cast<std::size_t>(along)];  // in cube edges
  const double angle = scenario.bend.angle_deg * kRadians * plant::smooth_step(part);
  const double twist = scenario.bend.twist_deg * kRadians * plant::smooth_step(part);
  const Eigen::Matrix3d bend = turned(along, aside, angle);
  const Eigen::Matrix3d rotation = bend * turned((along + 1) % 3, aside, twist);

  // An arc of this angle and length ends at (R sin, R (1 - cos)), R = length / angle. The end's centre is at
  // +length / 2 and the held end's at -length / 2.
  const bool is_straight = angle < 1e-9;
  Eigen::Vector3d shift = -length / 2.0 * bend.col(along);
  shift[along] += (is_straight ? length : length / angle * std::sin(angle)) - length / 2.0;
  shift[aside] += is_straight ? 0.0 : length / angle * (1.0 - std::cos(angle));

  RigidMotion motion = RigidMotion::identity();
  for (Eigen::Index i = 0; i < 9; ++i) {
    motion.rotation(i % 3, i / 3) = to_fixed<RotationEntry>(rotation(i % 3, i / 3));
  }
  for (Eigen::Index i = 0; i < 3; ++i) motion.translation[i] = to_fixed<Position>(shift[i]);
  return motion;
}

}  // namespace palpate::sim
