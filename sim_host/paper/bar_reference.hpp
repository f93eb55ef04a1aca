// The bar of cuboid-bend at rest in double precision: full corotation, which errors are measured from, and
// the two models that the paper compares with, St. Venant-Kirchhoff (NL-FEM) and linear (L-FEM).
//
// The reference's bar lies along z, is centred on the origin and bends towards x; the program's bends towards
// y. Positions of the program's bodies are turned by a quarter about z on their way.
#pragma once

#include <optional>

#include "reference/bisection_tree.hpp"
#include "reference/experiments.hpp"
#include "scenario/scenario.hpp"
#include "simulation/body_fields.hpp"

namespace palpate::sim {

using reference::Distance;
using reference::ElasticModel;

class BarReference {
 public:
  struct Equilibrium {
    reference::Positions x;  // m
    bool converged;
    double volume_change;  // of the whole bar, over its volume at rest
  };

  /// Solves for the pose of a complete cuboid-bend whose longest axis is z. Throws std::runtime_error if full
  /// corotation does not converge.
  explicit BarReference(const Scenario& scenario);

  /// The leaves of the uniform mesh and the tets that they come from.
  [[nodiscard]] const reference::BisectionTree& tree() const { return tree_; }
  /// In the frame in which the model is best solved.
  [[nodiscard]] reference::StaticProblem problem(ElasticModel model) const;
  [[nodiscard]] const Equilibrium& full() const { return full_; }
  [[nodiscard]] const Equilibrium& linear() const { return linear_; }
  [[nodiscard]] const Equilibrium& nonlinear() const { return nonlinear_; }

  /// Nodes that are neither held nor turned.
  [[nodiscard]] std::size_t free_nodes() const;
  [[nodiscard]] Distance distance(const reference::Positions& a, const reference::Positions& b) const;
  /// Nothing if the model did not converge.
  [[nodiscard]] std::optional<Distance> distance(const reference::Positions& a, const Equilibrium& b) const;

  /// Where a body's nodes are, matched with the reference's by their rest positions. Throws std::logic_error
  /// for a body with another mesh.
  [[nodiscard]] reference::Positions positions_of(const BodyFields& body) const;
  /// The other way: places of nodes whose rest positions are given, in millimetres as the program has them.
  [[nodiscard]] std::vector<std::array<double, 3>> place(const std::vector<std::array<double, 3>>& rest_mm,
                                                         const Equilibrium& equilibrium) const;

 private:
  [[nodiscard]] Equilibrium solve(ElasticModel model) const;
  [[nodiscard]] std::size_t node_at(const std::array<double, 3>& rest_mm) const;
  [[nodiscard]] reference::Vector to_reference(const std::array<double, 3>& mm) const;

  reference::Vector centre_mm_;
  double length_m_;
  reference::EndTurn turn_;
  reference::Material material_;
  reference::BisectionTree tree_;
  std::vector<bool> prescribed_;
  Equilibrium full_, linear_, nonlinear_;
};

}  // namespace palpate::sim
