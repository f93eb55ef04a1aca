// The motion of the turned end in cuboid-bend.
#pragma once

#include "palpate/solve/integrate.hpp"
#include "scenario/scenario.hpp"

namespace palpate::sim {

/// Twists the second held end about the bar's axis and puts it where the bar's centre line, its length kept,
/// is a circular arc; `part` 0 .. 1 of both angles, smoothly. The bar bends from its longest axis towards the
/// axis before it (z towards y); the twist is right-handed about the longest axis.
RigidMotion end_motion(const Scenario& scenario, double part);

}  // namespace palpate::sim
