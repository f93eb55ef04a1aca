// The golden scenario is written as integers; here they are held against what the model compiler makes of the
// SI values that its comments state.
#include <gtest/gtest.h>

#include "golden_body.hpp"
#include "model_parameters.hpp"

namespace palpate {
namespace {

sim::ModelParameters parameters_in_si() {
  const golden::Discretization& mesh = golden::kDiscretization;
  const double density = mesh.density_kg_m3;
  sim::ModelParameters parameters;
  parameters.cubes = {1, 1, 3};
  parameters.edge_m = 0.064;
  parameters.level = mesh.level;
  parameters.regions = {sim::RegionParameters{500.0, 0.49, density, mesh.least_level, mesh.most_level},
                        sim::RegionParameters{250.0, 0.49, density / 2, mesh.least_level, mesh.most_level}};
  parameters.region_of_cube = {0, 0, 1};
  parameters.substeps = mesh.substeps;
  parameters.mass_damping_per_s = 2.0;
  parameters.stiffness_damping_s = 50e-6;
  parameters.held = sim::HeldEnds::kOne;
  parameters.grasp_reach_m = 0.032;
  parameters.remesh.rotation = RotationCriterion::kMisfit;
  parameters.remesh.rotation_split_deg = 1.5;
  parameters.remesh.rotation_join_ratio = 0.85;
  parameters.remesh.stretch = StretchCriterion::kSixEdges;
  parameters.remesh.stretch_split = 0.06;
  parameters.remesh.stretch_merge_ratio = 0.5;
  return parameters;
}

const firmware::CycleModel& golden_model() { return firmware::kScenarioImage.model; }

void expect_same(LatticePoint a, LatticePoint b) { EXPECT_TRUE(a == b); }

TEST(GoldenModel, HasTheMaterialsOfItsSiValues) {
  const Model body = sim::compile_model(parameters_in_si());
  for (std::size_t region = 0; region < 2; ++region) {
    SCOPED_TRACE(region);
    EXPECT_EQ(golden_model().body.materials[region].shear.raw(), body.materials[region].shear.raw());
    EXPECT_EQ(golden_model().body.materials[region].bulk.raw(), body.materials[region].bulk.raw());
    EXPECT_EQ(golden_model().body.region_density[region], body.region_density[region]);
  }
}

TEST(GoldenModel, HasTheDynamicsOfItsSiValues) {
  const Dynamics dynamics = sim::compile_model(parameters_in_si()).dynamics;
  const Dynamics& golden = golden_model().body.dynamics;
  EXPECT_EQ(golden.substeps, dynamics.substeps);
  EXPECT_EQ(golden.mass_damping.raw(), dynamics.mass_damping.raw());
  EXPECT_EQ(golden.stiffness_damping.raw(), dynamics.stiffness_damping.raw());
  EXPECT_EQ(golden.impulse_mantissa.raw(), dynamics.impulse_mantissa.raw());
  EXPECT_EQ(golden.impulse_exponent, dynamics.impulse_exponent);
}

TEST(GoldenModel, HasTheRulesOfItsSiValues) {
  const RemeshRules rules = sim::compile_model(parameters_in_si()).remesh;
  const RemeshRules& golden = golden_model().body.remesh;
  EXPECT_EQ(golden.rotation.criterion, rules.rotation.criterion);
  EXPECT_EQ(golden.rotation.start_level, rules.rotation.start_level);
  EXPECT_EQ(golden.rotation.split_above, rules.rotation.split_above);
  EXPECT_EQ(golden.rotation.join_below, rules.rotation.join_below);
  EXPECT_EQ(golden.stretch.criterion, rules.stretch.criterion);
  EXPECT_EQ(golden.stretch.split_above.raw(), rules.stretch.split_above.raw());
  EXPECT_EQ(golden.stretch.merge_below.raw(), rules.stretch.merge_below.raw());
  for (std::size_t region = 0; region < kRegions; ++region) {
    EXPECT_EQ(golden.stretch.levels[region].least, rules.stretch.levels[region].least);
    EXPECT_EQ(golden.stretch.levels[region].most, rules.stretch.levels[region].most);
  }
}

TEST(GoldenModel, HasTheShapeOfItsSiValues) {
  const Model body = sim::compile_model(parameters_in_si());
  const Model& golden = golden_model().body;
  EXPECT_EQ(golden.level, body.level);
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_EQ(golden.block.cubes[axis], body.block.cubes[axis]);
  for (uint32_t cube = 0; cube < body.block.cube_count(); ++cube) {
    EXPECT_EQ(golden.block.region[cube], body.block.region[cube]);
  }
  expect_same(golden.held[0].min, body.held[0].min);
  expect_same(golden.held[0].max, body.held[0].max);
  expect_same(golden.held[1].min, body.held[1].min);
  expect_same(golden.held[1].max, body.held[1].max);
  EXPECT_EQ(golden.grasp_reach.raw(), body.grasp_reach.raw());
}

TEST(GoldenModel, HasTheSceneOfItsSiValues) {
  sim::SceneParameters in_si;
  // The body's centre in the device's frame is minus the device's origin in the body's frame.
  in_si.body_centre_in_device_m = {0.182, 0.0, -0.235};
  const firmware::Scene scene = sim::compile_scene(in_si, parameters_in_si());
  const firmware::Scene& golden = golden_model().scene;
  EXPECT_EQ(golden.edges_per_metre.raw(), scene.edges_per_metre.raw());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(golden.device_origin[axis].raw(), scene.device_origin[axis].raw());
  }
  EXPECT_EQ(golden.device_rotation, scene.device_rotation);
  EXPECT_EQ(golden.newton_mantissa.raw(), scene.newton_mantissa.raw());
  EXPECT_EQ(golden.newton_exponent, scene.newton_exponent);
}

}  // namespace
}  // namespace palpate
