// The image that the program wrote as C++ is the scenario, bit by bit. That it compiled as a constant is part
// of the test.
#include <gtest/gtest.h>

#include "scenario/grasp_script.hpp"
#include "simulation/capacity.hpp"
#include "support/models.hpp"

namespace palpate::sim {
namespace {

using firmware::kScenarioImage;

Scenario small_grasp() {
  Scenario scenario = built_in_scenario("grasp");
  scenario.profile = "small";
  scenario.model.regions[0].density_kg_m3 = 1000.0;
  scenario.model.contact.tool_radius_m = 0.004;
  scenario.scene.device_rotation_deg = {0.0, 0.0, 5.0};
  complete_scenario(scenario);
  fit_to_profile(scenario);
  return scenario;
}

TEST(FirmwareImage, HasTheScript) {
  const auto rows = grasp_script(small_grasp());
  ASSERT_EQ(kScenarioImage.row_count, rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(kScenarioImage.rows[i].encoder_counts, rows[i].encoder_counts);
    EXPECT_EQ(kScenarioImage.rows[i].buttons, rows[i].buttons);
  }
  EXPECT_STREQ(kScenarioImage.name, "grasp");
}

TEST(FirmwareImage, HasTheBody) {
  const Model expected = compile_model(small_grasp().model);
  const Model& body = kScenarioImage.model.body;
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_EQ(body.block.cubes[axis], expected.block.cubes[axis]);
  for (std::size_t i = 0; i < kMaxCubes; ++i) EXPECT_EQ(body.block.region[i], expected.block.region[i]);
  EXPECT_EQ(body.level, expected.level);
  for (std::size_t i = 0; i < kRegions; ++i) {
    EXPECT_EQ(body.materials[i].shear, expected.materials[i].shear);
    EXPECT_EQ(body.materials[i].bulk, expected.materials[i].bulk);
  }
  EXPECT_EQ(body.region_density, expected.region_density);
  for (std::size_t i = 0; i < kHolds; ++i) {
    EXPECT_EQ(body.held[i].min, expected.held[i].min);
    EXPECT_EQ(body.held[i].max, expected.held[i].max);
  }
  EXPECT_EQ(body.grasp_reach, expected.grasp_reach);
  test::expect_same(body.contact, expected.contact);
}

TEST(FirmwareImage, HasTheDynamics) {
  const Dynamics expected = compile_model(small_grasp().model).dynamics;
  const Dynamics& dynamics = kScenarioImage.model.body.dynamics;
  EXPECT_EQ(dynamics.substeps, expected.substeps);
  EXPECT_EQ(dynamics.mass_damping, expected.mass_damping);
  EXPECT_EQ(dynamics.stiffness_damping, expected.stiffness_damping);
  EXPECT_EQ(dynamics.impulse_mantissa, expected.impulse_mantissa);
  EXPECT_EQ(dynamics.impulse_exponent, expected.impulse_exponent);
}

TEST(FirmwareImage, HasTheScene) {
  const Scenario scenario = small_grasp();
  const firmware::Scene expected = compile_scene(scenario.scene, scenario.model);
  test::expect_same(kScenarioImage.model.scene, expected);
}

}  // namespace
}  // namespace palpate::sim
