#include "paper/model_sine.hpp"

#include <cmath>

#include "paper/reference_body.hpp"
#include "paper/traced_run.hpp"
#include "reference/body.hpp"
#include "reference/experiments.hpp"
#include "units.hpp"

namespace palpate::sim {
namespace {

using reference::Vector;

constexpr uint32_t kTwoPeriods = 10000;

reference::BodyParameters parameters_of(const Scenario& scenario, reference::ElasticModel model) {
  reference::BodyParameters parameters;
  parameters.materials = materials_of(scenario.model);
  parameters.substeps = static_cast<uint32_t>(scenario.model.substeps);
  parameters.mass_damping_per_s = scenario.model.mass_damping_per_s;
  parameters.stiffness_damping_s = scenario.model.stiffness_damping_s;
  parameters.grasp_reach_m = scenario.model.grasp_reach_m;
  parameters.model = model;
  return parameters;
}

}  // namespace

ModelTrace trace_model(const Scenario& scenario, reference::ElasticModel model) {
  const HeldMesh body_mesh = uniform_mesh(scenario);
  const reference::Mesh& mesh = body_mesh.mesh;
  reference::ReferenceBody body(mesh, parameters_of(scenario, model), body_mesh.held);
  const Vector driven =
      mesh.rest[reference::node_nearest(mesh, in_body_frame(scenario.node_mm, scenario.model))];
  const Vector top = reference::upper_corner(mesh);
  const uint32_t end = reference::node_nearest(mesh, Vector(0, 0, top[2]));
  const uint32_t ticks =
      scenario.ticks == Scenario::kAllTicks ? kTwoPeriods : static_cast<uint32_t>(scenario.ticks);

  ModelTrace trace;
  double farthest_m = 0.0;
  for (uint32_t k = 0; k < ticks; ++k) {
    const double u_m = 1e-3 * scenario.sine.amplitude_mm * std::sin(0.072 * k * kRadians);
    reference::BodyInput input;
    input.tool = driven + Vector(0, u_m, 0);
    input.close_grasp = true;
    const Vector force = body.tick(input);
    trace.force_n.push_back({force[0], force[1], force[2]});
    const double end_mm = 1e3 * (body.position()[end] - mesh.rest[end])[1];
    if ((k + 1) % kEndEvery == 0) trace.end_mm.push_back({(k + 1) * 1e-3, end_mm});
    if (std::abs(u_m) < farthest_m) continue;
    farthest_m = std::abs(u_m);
    trace.farthest = fields_of(mesh, body.position(), scenario);
  }
  return trace;
}

}  // namespace palpate::sim
