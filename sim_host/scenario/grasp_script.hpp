// The grasp scenario as the device sees it: the tool comes to a corner of the free end, takes it, drags it
// sideways, brings it back, lets go and leaves. Written as encoder counts, a row a tick.
#pragma once

#include "palpate/firmware/scenario_image.hpp"
#include "scenario/scenario.hpp"

namespace palpate::sim {

/// Joints stay this far from their limits.
inline constexpr double kLimitMarginDeg = 3.0;

struct ToolPoint {
  std::array<double, 3> position_m;  // in the device's frame
  bool grasp_button;
};

/// A point a tick, for a scenario that is complete.
std::vector<ToolPoint> grasp_path(const Scenario& scenario);

/// Throws BadInput where the arm does not reach or comes too near to a limit.
std::vector<firmware::ScriptRow> grasp_script(const Scenario& scenario);

}  // namespace palpate::sim
