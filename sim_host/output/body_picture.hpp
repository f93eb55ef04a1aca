// The picture of a body: its surface at rest and deformed, seen from outside, with the tool's path.
#pragma once

#include <string>

#include "output/recorder.hpp"

namespace palpate::sim {

/// A gnuplot script that writes body.svg and body.png.
std::string body_picture_script(const Recording& recording);

}  // namespace palpate::sim
