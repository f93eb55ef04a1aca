// Equilibrium of a body under prescribed displacements: Newton's method with the exact tangent and a line
// search on the energy, prescribed displacements applied in load steps. The paper's full corotation, NL-FEM
// (St. Venant-Kirchhoff) and L-FEM (linear) are this with three models.
#pragma once

#include <functional>
#include <vector>

#include "reference/elastic_model.hpp"

namespace palpate::reference {

struct StaticProblem {
  Mesh mesh;
  std::vector<Material> materials;
  std::vector<bool> prescribed;  // node by node
  /// Places the prescribed nodes of x for a load of 0 .. 1; it may also move the free ones to a better first
  /// guess.
  std::function<void(double load, Positions& x)> place;
  int load_steps = 10;
  double tolerance_n = 1e-10;  // of the largest force component on a free node
  ElasticModel model = ElasticModel::kCorotation;
};

struct StaticSolution {
  Positions x;
  std::vector<Vector> force;  // elastic, on every node, N; minus this holds a prescribed node
  double residual_n;
  int iterations;
  bool converged;
};

/// With one linear element a tet of the mesh.
StaticSolution solve_static(const StaticProblem& problem);

/// With other elements over the nodes problem.mesh.rest. For 4 and 10 nodes.
template <uint32_t Nodes>
StaticSolution solve_static(const StaticProblem& problem, const std::vector<ElementOf<Nodes>>& elements);

/// Elastic forces on all nodes, N, and the energy, J. For 4 and 10 nodes.
template <uint32_t Nodes>
std::vector<Vector> static_forces(const std::vector<ElementOf<Nodes>>& elements,
                                  const std::vector<Material>& materials, const Positions& x,
                                  ElasticModel model = ElasticModel::kCorotation);
template <uint32_t Nodes>
double static_energy(const std::vector<ElementOf<Nodes>>& elements, const std::vector<Material>& materials,
                     const Positions& x, ElasticModel model = ElasticModel::kCorotation);

}  // namespace palpate::reference
