// Where the body of a scenario comes to rest on a given mesh: the equilibrium of full corotation in double
// precision. Two meshes compared by it differ in nothing but the mesh.
#pragma once

#include "scenario/scenario.hpp"
#include "simulation/body_fields.hpp"

namespace palpate::sim {

struct RestSolution {
  BodyFields body;
  std::vector<bool> is_free;  // a node
  double reaction_n;          // on the driven node; 0 for a bend
};

/// A cuboid-bend, or a cuboid-sine with rest_at_peak, on the uniform mesh of scenario.model.level. Throws
/// std::runtime_error when Newton's method does not converge.
RestSolution solve_rest(const Scenario& scenario);
/// The same on the mesh of a body that was run.
RestSolution solve_rest(const Scenario& scenario, const BodyFields& body);

}  // namespace palpate::sim
