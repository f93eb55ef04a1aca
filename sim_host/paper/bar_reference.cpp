#include "paper/bar_reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "palpate/mesh/make_forest.hpp"
#include "palpate/tick/profiles.hpp"
#include "units.hpp"

namespace palpate::sim {
namespace {

using reference::BendFrame;
using reference::Positions;
using reference::StaticProblem;
using reference::Vector;

constexpr double kMm = 1e3;

/// From the program's axes to the reference's: y becomes x.
Vector turned(const Vector& p) { return {p[1], -p[0], p[2]}; }
Vector turned_back(const Vector& p) { return {-p[1], p[0], p[2]}; }

reference::BisectionTree tree_of(const ModelParameters& parameters) {
  const Model model = compile_model(parameters);
  const auto forest = std::make_unique<Forest<Workstation>>();
  if (make_roots(*forest, model.block, model.region_density) != MeshStatus::kDone ||
      refine_uniformly(*forest, model.level) != MeshStatus::kDone) {
    throw std::logic_error("the bar does not fit the workstation's profile");
  }
  reference::BisectionTree tree = reference::tree_of(*forest, parameters.edge_m);
  for (Vector& p : tree.mesh.rest) p = turned(p);
  return tree;
}

}  // namespace

BarReference::BarReference(const Scenario& scenario)
    : length_m_(scenario.model.cubes[2] * scenario.model.edge_m),
      turn_{scenario.bend.angle_deg * kRadians, scenario.bend.twist_deg * kRadians},
      tree_(tree_of(scenario.model)) {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    centre_mm_[axis] =
        scenario.model.cubes[static_cast<std::size_t>(axis)] * scenario.model.edge_m * kMm / 2.0;
  }
  const RegionParameters& tissue = scenario.model.regions[0];
  material_ = reference::material_of(tissue.youngs_modulus_pa, tissue.poisson_ratio, tissue.density_kg_m3);
  prescribed_ = problem(ElasticModel::kCorotation).prescribed;
  full_ = solve(ElasticModel::kCorotation);
  if (!full_.converged) {
    throw std::runtime_error(fmt::format(
        "the double-precision reference finds no equilibrium at {:g} degrees of bend and {:g} of twist",
        scenario.bend.angle_deg, scenario.bend.twist_deg));
  }
  linear_ = solve(ElasticModel::kLinear);
  nonlinear_ = solve(ElasticModel::kStVenantKirchhoff);
}

StaticProblem BarReference::problem(ElasticModel model) const {
  const bool is_nonlinear = model == ElasticModel::kStVenantKirchhoff;
  StaticProblem problem = turned_end_problem(tree_.mesh, material_, turn_,
                                             is_nonlinear ? BendFrame::kMiddle : BendFrame::kHeldEnd);
  problem.model = model;
  return problem;
}

BarReference::Equilibrium BarReference::solve(ElasticModel model) const {
  const reference::StaticSolution solution = solve_static(problem(model));
  const Positions x = model == ElasticModel::kStVenantKirchhoff
                          ? reference::in_held_end_frame(solution.x, length_m_, turn_.bend_rad)
                          : solution.x;
  return Equilibrium{x, solution.converged, reference::volume_change(tree_.mesh, x)};
}

std::size_t BarReference::free_nodes() const {
  return static_cast<std::size_t>(std::count(prescribed_.begin(), prescribed_.end(), false));
}

Distance BarReference::distance(const Positions& a, const Positions& b) const {
  return reference::distance_of(a, b, prescribed_);
}

std::optional<Distance> BarReference::distance(const Positions& a, const Equilibrium& b) const {
  if (!b.converged) return std::nullopt;
  return distance(a, b.x);
}

Vector BarReference::to_reference(const std::array<double, 3>& mm) const {
  return turned(Vector(mm.data()) - centre_mm_) / kMm;
}

std::size_t BarReference::node_at(const std::array<double, 3>& rest_mm) const {
  constexpr double kSamePlaceM = 1e-6;
  const Vector at = to_reference(rest_mm);
  const Positions& rest = tree_.mesh.rest;
  const auto found =
      std::find_if(rest.begin(), rest.end(), [&](const Vector& p) { return (p - at).norm() < kSamePlaceM; });
  if (found == rest.end()) throw std::logic_error("a node of the body is none of the reference's");
  return static_cast<std::size_t>(found - rest.begin());
}

Positions BarReference::positions_of(const BodyFields& body) const {
  if (body.rest_mm.size() != tree_.mesh.rest.size()) {
    throw std::logic_error("the body's mesh is not the reference's");
  }
  Positions x(body.rest_mm.size());
  for (std::size_t i = 0; i < x.size(); ++i) x[node_at(body.rest_mm[i])] = to_reference(body.now_mm[i]);
  return x;
}

std::vector<std::array<double, 3>> BarReference::place(const std::vector<std::array<double, 3>>& rest_mm,
                                                       const Equilibrium& equilibrium) const {
  std::vector<std::array<double, 3>> mm;
  for (const auto& at : rest_mm) {
    const Vector p = turned_back(equilibrium.x[node_at(at)]) * kMm + centre_mm_;
    mm.push_back({p[0], p[1], p[2]});
  }
  return mm;
}

}  // namespace palpate::sim
