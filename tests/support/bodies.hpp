// Whole bodies for tests: a model from SI values, its state, inputs, and ticks.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "compiled_stages.hpp"
#include "model_parameters.hpp"
#include "palpate/mesh/invariants.hpp"
#include "palpate/tick/hash.hpp"
#include "palpate/tick/profiles.hpp"
#include "reference/mesh_from_forest.hpp"
#include "support/fixed.hpp"
#include "support/misfits.hpp"

namespace palpate::test {

inline TickInput input_at_rest() {
  TickInput input{};
  input.tool = zero_vector<Position>();
  input.hold_motion = {RigidMotion::identity(), RigidMotion::identity()};
  return input;
}

template <class Profile>
std::unique_ptr<State<Profile>> started(const Model& model) {
  auto state = std::make_unique<State<Profile>>();
  EXPECT_EQ(start(*state, model), Status::kDone);
  return state;
}

template <class Profile>
TickOutput tick_once(State<Profile>& state, const TickInput& input) {
  TickOutput output{};
  NoProbe probe;
  tick(state, input, output, probe);
  return output;
}

/// Forces at the nodes' positions, and what is seen of each group. Returns the number of clamped leaves.
template <class Profile>
uint32_t evaluate_forces(State<Profile>& state) {
  renew_all_misfits(state.forest, state.front, state.groups);
  GroupForces<Profile> forces(state.forest, state.front, state.groups, state.model.materials, state.frame);
  return forces.template evaluate<Observe::kYes>(state.forest.node.position);
}

/// The paper's bar, coarse: quick to step. Full corotation, so its profile needs a group a leaf.
inline sim::ModelParameters coarse_bar(double density_kg_m3, int substeps) {
  sim::ModelParameters parameters;
  parameters.level = 3;
  parameters.regions[0].density_kg_m3 = density_kg_m3;
  parameters.substeps = substeps;
  parameters.remesh.rotation = RotationCriterion::kFull;
  return parameters;
}

template <class Profile>
uint16_t node_at(const Forest<Profile>& forest, LatticePoint point) {
  for (uint32_t i = 0; i < forest.nodes.used(); ++i) {
    if (forest.node.rest[forest.nodes.live(i)] == point) return forest.nodes.live(i);
  }
  return kNone;
}

inline reference::BodyParameters reference_parameters(const sim::ModelParameters& parameters) {
  reference::BodyParameters out;
  for (const auto& region : parameters.regions) {
    out.materials.push_back(
        reference::material_of(region.youngs_modulus_pa, region.poisson_ratio, region.density_kg_m3));
  }
  out.substeps = static_cast<uint32_t>(parameters.substeps);
  out.mass_damping_per_s = parameters.mass_damping_per_s;
  out.stiffness_damping_s = parameters.stiffness_damping_s;
  out.grasp_reach_m = parameters.grasp_reach_m;
  return out;
}

inline reference::BodyInput reference_input(const TickInput& input, double edge_m) {
  reference::BodyInput out;
  out.tool = reference::in_metres(input.tool, edge_m);
  out.close_grasp = input.close_grasp;
  for (uint32_t i = 0; i < kHolds; ++i)
    out.hold_motion[i] = reference::rigid_motion(input.hold_motion[i], edge_m);
  return out;
}

}  // namespace palpate::test
