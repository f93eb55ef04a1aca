// From which level to which a mesh changes, and what a user gets who says nothing of it.
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "simulation/capacity.hpp"

namespace palpate::test {
namespace {

Model compiled(sim::Scenario scenario) {
  sim::complete_scenario(scenario);
  sim::fit_to_profile(scenario);
  return sim::compile_model(scenario.model);
}

TEST(MeshLevels, AreThoseOfTheStartUnlessGiven) {
  for (const std::string& name : sim::scenario_names()) {
    const Model model = compiled(sim::built_in_scenario(name));
    EXPECT_EQ(model.remesh.stretch.criterion, StretchCriterion::kFixed) << "nothing to do, at no cost";
    for (const LevelRange& levels : model.remesh.stretch.levels) {
      EXPECT_EQ(levels.least, model.level);
      EXPECT_EQ(levels.most, model.level);
    }
  }
}

TEST(MeshLevels, OneThatIsGivenOpensTheRange) {
  sim::Scenario scenario = sim::built_in_scenario("grasp");
  scenario.model.regions[0].least_level = 3;
  const Model coarsened = compiled(scenario);
  EXPECT_EQ(coarsened.remesh.stretch.criterion, sim::RemeshParameters{}.stretch);
  EXPECT_NE(coarsened.remesh.stretch.criterion, StretchCriterion::kFixed);
  EXPECT_EQ(coarsened.remesh.stretch.levels[0].least, 3);
  EXPECT_EQ(coarsened.remesh.stretch.levels[0].most, 6);
  scenario.stretch = "fixed";
  EXPECT_EQ(compiled(scenario).remesh.stretch.criterion, StretchCriterion::kFixed);
}

TEST(MeshLevels, AnAutomaticLevelIsNotAboveTheMost) {
  sim::Scenario scenario = sim::built_in_scenario("grasp");
  scenario.model.regions[0].least_level = 2;
  scenario.model.regions[0].most_level = 4;
  EXPECT_EQ(compiled(scenario).level, 4);
}

/// With the default criterion and a closed range the bits are those of a fixed mesh.
TEST(MeshLevels, AClosedRangeIsAFixedMesh) {
  const TemporaryFolder folder;
  const std::string run = "run cuboid-sine --level 3 --ticks 300";
  const nlohmann::json by_default = summary_of_run(folder, run);
  const nlohmann::json fixed = summary_of_run(folder, run + " --stretch fixed");
  EXPECT_EQ(by_default["state_hash"], fixed["state_hash"]);
  EXPECT_EQ(by_default["parameters"]["least_level"], 3);
  EXPECT_EQ(by_default["parameters"]["most_level"], 3);
  EXPECT_NE(by_default["parameters"]["stretch"], "fixed");
}

TEST(MeshLevels, AnOpenRangeRefinesWithoutAnotherWord) {
  const TemporaryFolder folder;
  const nlohmann::json refined =
      summary_of_run(folder, "run cuboid-sine --level 3 --most-level 5 --ticks 500");
  EXPECT_GT(refined["tets"], 144);
  const nlohmann::json coarsened =
      summary_of_run(folder, "run cuboid-sine --level 3 --least-level 1 --ticks 500");
  EXPECT_LT(coarsened["tets"], 144);
}

/// Nodes that were drawn to be merged and let go, in turns, kept it from coming to rest. Three times as heavy
/// as the paper's bar, whose lightest nodes tremble by as much as rest allows.
TEST(SlowMeshLevels, AMeshThatIsRefinedComesToRest) {
  const TemporaryFolder folder;
  const nlohmann::json summary =
      summary_of_run(folder,
                     "run cuboid-sine --rest-at-peak on --profile workstation --theta 0.2 --level 3 "
                     "--most-level 6 --stretch longest-edge --stretch-split 0.001 --density-kg-m3 30");
  EXPECT_LT(summary["ticks"], 5000);
}

TEST(MeshLevels, ARegionHasItsOwn) {
  const TemporaryFolder folder;
  write_text(folder / "bar.toml",
             "scenario = 'cuboid-sine'\nlevel = 3\nleast_level = 2\nticks = 50\nregion_of_cube = [0, 1, 1]\n"
             "[[region]]\nmost_level = 4\n[[region]]\nleast_level = 1\n");
  const nlohmann::json regions = summary_of_run(folder, "run bar.toml")["parameters"]["region"];
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_EQ(regions[0]["least_level"], 2);
  EXPECT_EQ(regions[0]["most_level"], 4);
  EXPECT_EQ(regions[1]["least_level"], 1);
  EXPECT_EQ(regions[1]["most_level"], 3);
}

TEST(MeshLevels, AreDescribed) {
  const TemporaryFolder folder;
  const std::string fixed = run_program(folder, "model grasp").out;
  EXPECT_NE(fixed.find("mesh           stays as it is\n"), std::string::npos) << fixed;
  const std::string open = run_program(folder, "model grasp --least-level 3").out;
  EXPECT_NE(open.find("levels 3 to 6"), std::string::npos) << open;
  EXPECT_NE(open.find("is split where six-edges is above 0.1, merged below 0.05\n"), std::string::npos)
      << open;
}

}  // namespace
}  // namespace palpate::test
