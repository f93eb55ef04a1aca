#include "hil/touch_task.hpp"

#include <fmt/format.h>

#include "plant/premium.hpp"
#include "scenario/grasp_script.hpp"

namespace palpate::sim {
namespace {

using Eigen::Vector3d;

/// Free of the surface, so that neither noise nor the arm's weight brings the tool to it.
constexpr double kClearM = 0.003;

/// Where the hand has the tool's centre, so many metres beyond where the ball just touches the node's place.
Vector3d beyond_surface(const Scenario& scenario, double metres) {
  std::array<double, 3> from_centre = node_from_centre_m(scenario);
  from_centre[1] += metres - scenario.model.contact.tool_radius_m;
  return Vector3d(in_device_m(scenario.scene, from_centre).data());
}

/// Hold still in the reset pose until the device gives its whole force; touch and press; leave the surface a
/// little, grasp, pull, let go, go home.
std::vector<plant::Knot> knots(const Scenario& scenario) {
  const TouchParameters& touch = scenario.touch;
  const Vector3d home = plant::premium::tool_position(Vector3d::Zero());
  const auto at = [&scenario](double metres) { return beyond_surface(scenario, metres); };
  const double pull = touch.pull_mm * 1e-3;
  return {
      {0.0, home},
      {0.4, home},
      {2.4, at(-kClearM)},
      {2.8, at(touch.press_mm * 1e-3)},
      {3.2, at(touch.press_mm * 1e-3)},
      {3.6, at(-kClearM)},
      {3.8, at(-kClearM), true, plant::kGraspButton},
      {5.0, at(-kClearM - pull), true, plant::kGraspButton},
      {5.4, at(-kClearM - pull)},
      {6.2, home},
      {6.5, home},
  };
}

void require_reach(const std::vector<plant::Knot>& knots) {
  namespace premium = plant::premium;
  for (const plant::Knot& knot : knots) {
    const auto angles = premium::inverse_kinematics(knot.position);
    const double margin = angles ? plant::degrees(plant::margin_to_limits(premium::kLimits, *angles)) : -1.0;
    if (margin >= kLimitMarginDeg) continue;
    throw BadInput(fmt::format(
        "the hand cannot go there: at {:g} s to ({:.0f}, {:.0f}, {:.0f}) mm, out of the arm's reach or less "
        "than "
        "{:g} degrees from a joint's limit; change body_centre_in_device_m, node_mm or pull_mm",
        knot.time, knot.position[0] * 1e3, knot.position[1] * 1e3, knot.position[2] * 1e3, kLimitMarginDeg));
  }
}

}  // namespace

plant::Plant touch_plant(const Scenario& scenario) {
  const auto path = knots(scenario);
  require_reach(path);
  return plant::Plant({}, plant::Hand({}, plant::Intention::scripted(path)));
}

uint32_t touch_ticks(const Scenario& scenario) {
  const auto whole = static_cast<uint32_t>(knots(scenario).back().time / plant::kTickSeconds);
  return scenario.ticks == Scenario::kAllTicks ? whole : static_cast<uint32_t>(scenario.ticks);
}

}  // namespace palpate::sim
