// Pictures of a recording, drawn by gnuplot as a child process.
#pragma once

#include <filesystem>

#include "recording/inspection.hpp"

namespace palpate::sim {

/// counts.svg, codes.svg and state.svg into a folder.
void draw_recording(const recording::Curves& curves, const std::filesystem::path& folder);

}  // namespace palpate::sim
