// The motion of the turned end in cuboid-bend.
#pragma once

#include "palpate/solve/integrate.hpp"
#include "scenario/scenario.hpp"

namespace palpate::sim {

/// Puts the second held end where the bar's centre line, its length kept, is a circular arc; `part` 0 .. 1 of
/// the angle, smoothly. The bar bends from its longest axis towards the axis before it (z towards y).
RigidMotion end_motion(const Scenario& scenario, double part);

}  // namespace palpate::sim
