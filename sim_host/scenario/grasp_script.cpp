#include "scenario/grasp_script.hpp"

#include <fmt/format.h>

#include <cmath>

#include "plant/premium.hpp"
#include "plant/smooth_step.hpp"

namespace palpate::sim {
namespace {

/// From above and beside in the device's frame, so that the arm keeps away from its limits.
constexpr std::array<double, 3> kApproachFromM = {0.0, 0.024, 0.032};

struct Phase {
  int ticks;
  double away;     // at its end: 1 at the start of the approach, 0 at the corner
  double dragged;  // at its end, of the whole drag
  bool grasp_button;
};

constexpr std::array<Phase, 7> kPhases = {{
    {300, 0.0, 0.0, false},  // approach
    {200, 0.0, 0.0, false},  // dwell
    {1200, 0.0, 1.0, true},  // drag
    {300, 0.0, 1.0, true},   // hold
    {1200, 0.0, 0.0, true},  // back
    {300, 0.0, 0.0, false},  // let go
    {300, 1.0, 0.0, false},  // retract
}};

firmware::ScriptRow row_at(const ToolPoint& point, std::size_t tick) {
  const auto angles = plant::premium::inverse_kinematics(Eigen::Vector3d(point.position_m.data()));
  const double margin_deg =
      angles ? plant::degrees(plant::margin_to_limits(plant::premium::kLimits, *angles)) : 0.0;
  if (!angles || margin_deg < kLimitMarginDeg) {
    const auto& p = point.position_m;
    throw BadInput(fmt::format(
        "the tool cannot follow the path: at {} ms it is at ({:.0f}, {:.0f}, {:.0f}) mm, {}; change "
        "body_centre_in_device_m or drag_mm",
        tick, p[0] * 1e3, p[1] * 1e3, p[2] * 1e3,
        angles ? fmt::format("{:.1f} degrees from a joint's limit ({:g} needed)", margin_deg, kLimitMarginDeg)
               : "out of the arm's reach"));
  }
  const auto counts = plant::encoder_counts(plant::premium::kEncoders, *angles);
  firmware::ScriptRow row{};
  for (std::size_t joint = 0; joint < 3; ++joint) {
    row.encoder_counts[joint] = static_cast<int16_t>(std::lround(counts[static_cast<Eigen::Index>(joint)]));
  }
  row.buttons = point.grasp_button ? firmware::ScriptRow::kGraspButton : uint16_t{0};
  return row;
}

}  // namespace

std::vector<ToolPoint> grasp_path(const Scenario& scenario) {
  const auto corner = node_from_centre_m(scenario);
  const double drag_m = scenario.grasp.drag_mm * 1e-3;
  std::vector<ToolPoint> path;
  double away = 1.0;
  double dragged = 0.0;
  for (const Phase& phase : kPhases) {
    for (int tick = 0; tick < phase.ticks; ++tick) {
      const double part = plant::smooth_step(static_cast<double>(tick) / phase.ticks);
      const double away_now = away + part * (phase.away - away);
      std::array<double, 3> tool = corner;
      tool[1] += (dragged + part * (phase.dragged - dragged)) * drag_m;
      ToolPoint point{in_device_m(scenario.scene, tool), phase.grasp_button};
      for (std::size_t axis = 0; axis < 3; ++axis) point.position_m[axis] += away_now * kApproachFromM[axis];
      path.push_back(point);
    }
    away = phase.away;
    dragged = phase.dragged;
  }
  return path;
}

std::vector<firmware::ScriptRow> grasp_script(const Scenario& scenario) {
  std::vector<firmware::ScriptRow> rows;
  for (const ToolPoint& point : grasp_path(scenario)) rows.push_back(row_at(point, rows.size()));
  if (scenario.ticks != Scenario::kAllTicks && static_cast<std::size_t>(scenario.ticks) < rows.size()) {
    rows.resize(static_cast<std::size_t>(scenario.ticks));
  }
  return rows;
}

}  // namespace palpate::sim
