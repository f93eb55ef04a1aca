// Scenarios whose tool touches, and devices that stand turned beside the body, through the program.
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "scenario/grasp_script.hpp"
#include "simulation/capacity.hpp"

namespace palpate::test {
namespace {

bool has_flag(const nlohmann::json& summary, const std::string& name) {
  const auto& flags = summary["flags"];
  return std::find(flags.begin(), flags.end(), name) != flags.end();
}

TEST(TouchScenario, ARadiusIsEnough) {
  const TemporaryFolder folder;
  const auto without = summary_of_run(folder, "hil grasp --level 3 --ticks 300");
  const auto with = summary_of_run(folder, "hil grasp --level 3 --ticks 300 --tool-radius-m 0.005");
  EXPECT_FALSE(has_flag(without, "touching"));
  EXPECT_TRUE(has_flag(with, "touching"));
  EXPECT_EQ(without["parameters"]["tool_radius_m"], 0.0);
  // What was automatic is told.
  for (const char* key : {"contact_stiffness_n_m", "contact_damping_n_s_m", "contact_force_limit_n",
                          "contact_slew_n_per_tick", "passivity_damping_n_s_m"}) {
    EXPECT_GT(with["parameters"][key], 0.0) << key;
  }
}

TEST(TouchScenario, EveryKindTakesIt) {
  const TemporaryFolder folder;
  write_text(folder / "sine.toml",
             "scenario = 'cuboid-sine'\nlevel = 3\ntool_radius_m = 0.004\ncontact_friction = 0.1\n");
  EXPECT_EQ(summary_of_run(folder, "run sine.toml --ticks 20")["parameters"]["contact_friction"], 0.1);
  const Outcome bend =
      run_program(folder, "run cuboid-bend --level 3 --ticks 20 --tool-radius-m 0.004 --plots off --out run");
  EXPECT_EQ(bend.exit_code, 1) << "it does not come to rest in 20 ticks: " << bend.err;
  EXPECT_EQ(summary_of(folder)["parameters"]["tool_radius_m"], 0.004);
}

TEST(TouchScenario, WhatWouldSwingIsRefused) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run_program(folder, "run cuboid-sine --level 3 --tool-radius-m 0.005 --contact-stiffness-n-m 500");
  EXPECT_EQ(outcome.exit_code, 2);
  expect_one_line(outcome.err);
  EXPECT_NE(outcome.err.find("contact_stiffness_n_m is 500, but must be"), std::string::npos) << outcome.err;
  const Outcome thin = run_program(folder, "run cuboid-sine --tool-radius-m 0.0001");
  EXPECT_EQ(thin.exit_code, 2);
  EXPECT_NE(thin.err.find("must be 0, or 0.001 to 0.032"), std::string::npos) << thin.err;
  EXPECT_EQ(folder.contents(), std::vector<std::string>{});
}

TEST(DeviceScenario, TellsItsFrame) {
  const TemporaryFolder folder;
  const auto plain = summary_of_run(folder, "hil grasp --level 3 --ticks 20")["device"];
  EXPECT_EQ(plain["rotation"], nlohmann::json::parse("[[1.0,0.0,0.0],[0.0,1.0,0.0],[0.0,0.0,1.0]]"));
  EXPECT_EQ(plain["work_scale"], 1.0);
  const std::string flags = " --device-rotation-deg 0,0,5 --motion-scale 1.25 --force-scale 10";
  const Outcome outcome = run_program(folder, "hil grasp --level 3 --ticks 20 --plots off --out run" + flags);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(
      outcome.out.find("turned by 0, 0, 5 deg, at 0.18, 0, -0.17 m; motion x 1.25, force x 10, work x 8"),
      std::string::npos)
      << outcome.out;
  EXPECT_EQ(summary_of(folder)["device"]["work_scale"], 8.0);
  EXPECT_FALSE(summary_of_run(folder, "run cuboid-sine --level 3 --ticks 5").contains("device"));
}

/// The hand goes where the tool has to be: a device that is turned and scaled drags the same corner, by as
/// much, and feels the same force in its own axes. Steps of the encoders shake the corner by some percent.
TEST(DeviceScenario, ATurnedDeviceDragsTheSameCorner) {
  const TemporaryFolder folder;
  const auto plain = summary_of_run(folder, "hil grasp --level 3");
  const auto turned =
      summary_of_run(folder, "hil grasp --level 3 --device-rotation-deg 4,-6,8 --motion-scale 1.25");
  EXPECT_TRUE(has_flag(turned, "grasping"));
  const double force = plain["peak_force_N"];
  EXPECT_NEAR(turned["peak_force_N"], force, 0.05 * force);
}

TEST(DeviceScenario, ItsPathIsTheBodysTurnedBack) {
  sim::Scenario scenario = sim::built_in_scenario("grasp");
  scenario.model.level = 3;
  complete_scenario(scenario);
  const auto plain = grasp_path(scenario);
  const sim::SceneParameters before = scenario.scene;
  scenario.scene.device_rotation_deg = {4.0, -6.0, 8.0};
  scenario.scene.motion_scale = 1.25;
  const auto turned = grasp_path(scenario);
  ASSERT_EQ(plain.size(), turned.size());
  for (std::size_t i = 300; i < plain.size() - 300; ++i) {  // at the corner and away with it
    std::array<double, 3> from_centre{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      from_centre[axis] = plain[i].position_m[axis] - before.body_centre_in_device_m[axis];
    }
    const auto expected = in_device_m(scenario.scene, from_centre);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ASSERT_NEAR(turned[i].position_m[axis], expected[axis], 1e-12) << i;
    }
  }
}

}  // namespace
}  // namespace palpate::test
