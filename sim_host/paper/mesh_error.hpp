// How far two deformations of one body on different meshes are apart.
#pragma once

#include "simulation/body_fields.hpp"

namespace palpate::sim {

struct MeshError {
  double mean_mm, max_mm;
};

/// At the nodes of `fine` that its loads leave free: the displacement of `coarse`, linear in its tets, less
/// that of the node. Coarse tets must cover the body.
MeshError error_of(const BodyFields& coarse, const BodyFields& fine, const std::vector<bool>& is_free);

}  // namespace palpate::sim
