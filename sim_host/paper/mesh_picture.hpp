// Pictures of meshes side by side: the surface coloured by the level of its tets, with bold red lines where
// the rotation changes from one tet to the next, as the paper draws them.
#pragma once

#include <string>
#include <vector>

#include "simulation/body_fields.hpp"

namespace palpate::sim {

struct MeshPanel {
  std::string title;
  const BodyFields* body;
  bool shows_rotation_tets = true;
};

/// A gnuplot script that writes `file` (.svg).
std::string mesh_picture_script(const std::string& file, const std::vector<MeshPanel>& panels);

}  // namespace palpate::sim
