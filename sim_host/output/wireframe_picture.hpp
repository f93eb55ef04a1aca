// Pictures of bodies as wireframes, all in one scale and seen from one side: the mesh's edges thin and grey,
// the edges of the tets whose rotation is extracted bold and red.
#pragma once

#include <string>
#include <vector>

#include "simulation/simulation.hpp"

namespace palpate::sim {

struct WireframePicture {
  std::string file;  // without its ending
  BodyShape shape;
  bool shows_rotation_tets = true;
};

/// A gnuplot script that writes <file>.svg and <file>.png.
std::string wireframe_script(const std::vector<WireframePicture>& pictures);

}  // namespace palpate::sim
