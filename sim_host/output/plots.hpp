// Pictures of a run, drawn by gnuplot as a child process.
#pragma once

#include "output/recorder.hpp"

namespace palpate::sim {

/// force.svg, displacement.svg, with a device motor_codes.svg, and body.svg and body.png: the surface at rest
/// and at its farthest, with the tool's path. Reads force.csv of the folder.
void draw_plots(const Recording& recording, bool has_device, const RunFolder& folder);

}  // namespace palpate::sim
