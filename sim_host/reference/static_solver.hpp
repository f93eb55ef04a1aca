// Equilibrium of a fully corotated body under prescribed displacements: Newton's method with the exact
// tangent and a line search on the energy, prescribed displacements applied in load steps.
#pragma once

#include <functional>
#include <vector>

#include "reference/mesh.hpp"

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
};

struct StaticSolution {
  Positions x;
  std::vector<Vector> force;  // elastic, on every node, N; minus this holds a prescribed node
  double residual_n;
  int iterations;
  bool converged;
};

StaticSolution solve_static(const StaticProblem& problem);

/// Elastic forces on all nodes with polar rotations, N, and the energy, J.
std::vector<Vector> static_forces(const std::vector<Element>& elements,
                                  const std::vector<Material>& materials, const Positions& x);
double static_energy(const std::vector<Element>& elements, const std::vector<Material>& materials,
                     const Positions& x);

}  // namespace palpate::reference
