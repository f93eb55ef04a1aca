#include "paper/rest_solution.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "paper/reference_body.hpp"
#include "reference/experiments.hpp"
#include "reference/mesh_from_forest.hpp"
#include "simulation/arc.hpp"

namespace palpate::sim {
namespace {

using reference::StaticProblem;
using reference::Vector;

constexpr int kLoadSteps = 15;

/// The first guess of a load step goes on as the last two steps went.
void extrapolate(reference::Positions& x, reference::Positions& before) {
  const reference::Positions now = x;
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += x[i] - before[i];
  before = now;
}

StaticProblem bend_of(const Scenario& scenario, const HeldMesh& body) {
  StaticProblem problem;
  problem.mesh = body.mesh;
  problem.materials = materials_of(scenario.model);
  for (const uint8_t held : body.held) problem.prescribed.push_back(held != 0);
  problem.load_steps = kLoadSteps;
  problem.place = [scenario, body, before = body.mesh.rest](double load, reference::Positions& x) mutable {
    extrapolate(x, before);
    const auto motion = reference::rigid_motion(end_motion(scenario, load), scenario.model.edge_m);
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (body.held[i] == 1) x[i] = body.mesh.rest[i];
      if (body.held[i] == 2) x[i] = motion.rotation * body.mesh.rest[i] + motion.translation;
    }
  };
  return problem;
}

RestSolution solve_on(const HeldMesh& body, const Scenario& scenario) {
  const bool is_bend = scenario.kind == ScenarioKind::kBend;
  const uint32_t driven = reference::node_nearest(body.mesh, in_body_frame(scenario.node_mm, scenario.model));
  const StaticProblem problem =
      is_bend ? bend_of(scenario, body)
              : reference::driven_node_problem(body.mesh, materials_of(scenario.model)[0],
                                               scenario.model.held == HeldEnds::kBoth, driven,
                                               Vector(0, scenario.sine.amplitude_mm * 1e-3, 0));
  const reference::StaticSolution solution = reference::solve_static(problem);
  if (!solution.converged) {
    throw std::runtime_error(fmt::format("the reference finds no equilibrium of {} on {} tets", scenario.name,
                                         body.mesh.tet.size()));
  }
  RestSolution rest{fields_of(body.mesh, solution.x, scenario), {}, 0.0};
  for (const bool is_prescribed : problem.prescribed) rest.is_free.push_back(!is_prescribed);
  if (!is_bend) rest.reaction_n = solution.force[driven].norm();
  return rest;
}

}  // namespace

RestSolution solve_rest(const Scenario& scenario) { return solve_on(uniform_mesh(scenario), scenario); }

RestSolution solve_rest(const Scenario& scenario, const BodyFields& body) {
  return solve_on(mesh_of(body, scenario), scenario);
}

}  // namespace palpate::sim
