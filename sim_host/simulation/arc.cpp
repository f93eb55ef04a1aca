#include "simulation/arc.hpp"

#include <algorithm>
#include <cmath>

#include "scenario/smooth_step.hpp"
#include "units.hpp"

namespace palpate::sim {

RigidMotion end_motion(const Scenario& scenario, double part) {
  constexpr double kRadians = 3.14159265358979323846 / 180.0;
  const auto& cubes = scenario.model.cubes;
  const auto along = std::max_element(cubes.begin(), cubes.end()) - cubes.begin();
  const auto aside = (along + 2) % 3;
  const double length = cubes[static_cast<std::size_t>(along)];  // in cube edges
  const double angle = scenario.bend.angle_deg * kRadians * smooth_step(part);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  // An arc of this angle and length ends at (R sin, R (1 - cos)), R = length / angle.
  const bool is_straight = angle < 1e-9;
  const double end_along = is_straight ? length : length / angle * s;
  const double end_aside = is_straight ? 0.0 : length / angle * (1.0 - c);

  RigidMotion motion = RigidMotion::identity();
  motion.rotation(along, along) = to_fixed<RotationEntry>(c);
  motion.rotation(aside, aside) = to_fixed<RotationEntry>(c);
  motion.rotation(aside, along) = to_fixed<RotationEntry>(s);
  motion.rotation(along, aside) = to_fixed<RotationEntry>(-s);
  // The end's centre is at +length / 2 and the held end's at -length / 2.
  motion.translation[along] = to_fixed<Position>(end_along - length / 2.0 - c * length / 2.0);
  motion.translation[aside] = to_fixed<Position>(end_aside - s * length / 2.0);
  return motion;
}

}  // namespace palpate::sim
