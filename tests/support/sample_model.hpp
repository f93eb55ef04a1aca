// A model with something in every field.
#pragma once

#include "model_parameters.hpp"
#include "palpate/firmware/model_container.hpp"

namespace palpate::test {

using firmware::CycleModel;

/// Two materials, a hole, a mesh that changes, both ends held, a tool that touches; no two numbers alike by
/// chance.
inline CycleModel sample_model() {
  sim::ModelParameters parameters;
  parameters.cubes = {1, 2, 2};
  parameters.region_of_cube = {0, 1, -1, 1};
  parameters.level = 2;
  parameters.regions = {{500.0, 0.49, 1000.0, 1, 5}, {300.0, 0.4, 600.0, 2, 4}};
  parameters.substeps = 1;
  parameters.held = sim::HeldEnds::kBoth;
  parameters.grasp_reach_m = 0.02;
  parameters.contact.tool_radius_m = 0.004;
  parameters.contact.stiffness_n_m = 20.0;
  parameters.contact.damping_n_s_m = 0.012;
  sim::SceneParameters scene;
  scene.body_centre_in_device_m = {0.11, -0.02, -0.13};
  scene.device_rotation_deg = {10.0, -20.0, 35.0};
  scene.motion_scale = 0.7;
  scene.force_scale = 3.0;
  return CycleModel{compile_model(parameters), compile_scene(scene, parameters)};
}

}  // namespace palpate::test
