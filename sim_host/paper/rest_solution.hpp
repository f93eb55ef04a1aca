// Where the body of a scenario comes to rest on a uniform mesh, by the double-precision reference with full
// corotation: what adaptive meshes are compared with.
#pragma once

#include "scenario/scenario.hpp"
#include "simulation/body_fields.hpp"

namespace palpate::sim {

struct RestSolution {
  BodyFields body;
  std::vector<bool> is_free;  // a node
  double reaction_n;          // on the driven node; 0 for a bend
};

/// A cuboid-bend, or a cuboid-sine with rest_at_peak, on the mesh of scenario.model.level.
RestSolution solve_rest(const Scenario& scenario);

}  // namespace palpate::sim
