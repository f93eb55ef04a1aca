// What a run writes.
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "program.hpp"

namespace palpate::test {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

void expect_same_folders(const TemporaryFolder& folder, const std::string& first, const std::string& second) {
  for (const auto& entry : std::filesystem::directory_iterator(folder / first)) {
    const auto other = folder / second / entry.path().filename();
    EXPECT_TRUE(std::filesystem::exists(other)) << other;
    EXPECT_EQ(read_text(entry.path()), read_text(other)) << entry.path();
  }
}

TEST(RunFolder, TwoRunsAreTheSameFile) {
  const TemporaryFolder folder;
  for (const char* name : {"a", "b"}) {
    const Outcome outcome =
        run_program(folder, std::string("run cuboid-sine --level 3 --ticks 150 --out ") + name);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");  // no progress bar: standard error is a file
  }
  expect_same_folders(folder, "a", "b");
  EXPECT_EQ(run_program(folder, "compare a b").exit_code, 0);
}

TEST(RunFolder, HoldsWhatIsPromised) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run_program(folder, "hil grasp --level 3 --substeps 2 --ticks 130 --hash-every 50 --out nested/run");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::vector<std::string> expected = {"nested",
                                             "nested/run",
                                             "nested/run/body.png",
                                             "nested/run/body.svg",
                                             "nested/run/displacement.svg",
                                             "nested/run/force.csv",
                                             "nested/run/force.svg",
                                             "nested/run/hash.csv",
                                             "nested/run/motor_codes.svg",
                                             "nested/run/nodes.csv",
                                             "nested/run/summary.json"};
  EXPECT_EQ(folder.contents(), expected);
  const auto summary = summary_of(folder, "nested/run");
  EXPECT_EQ(summary["scenario"], "grasp");
  EXPECT_EQ(summary["profile"], "cuboid-paper");
  EXPECT_EQ(summary["ticks"], 130);
  EXPECT_EQ(summary["tets"], 144);
  EXPECT_EQ(summary["parameters"]["substeps"], 2);

  const auto forces = lines_of(read_text(folder / "nested/run/force.csv"));
  EXPECT_EQ(forces.size(), 131U);
  EXPECT_EQ(
      forces[0],
      "tick,time_ms,tool_x_mm,tool_y_mm,tool_z_mm,displacement_x_mm,displacement_y_mm,displacement_z_mm,"
      "force_x_N,force_y_N,force_z_N,motor_1_code,motor_2_code,motor_3_code,tets,rotation_tets,flags");
  const auto hashes = lines_of(read_text(folder / "nested/run/hash.csv"));
  ASSERT_EQ(hashes.size(), 4U);
  EXPECT_EQ(hashes[0], "tick,kinematics,touch,remesh,rotations,forces,integrate,reaction,motor_codes,state");
  EXPECT_EQ(hashes[1].rfind("50,", 0), 0U);
  EXPECT_EQ(hashes[3].rfind("130,", 0), 0U);
  EXPECT_EQ(hashes[3].substr(hashes[3].size() - 16), summary["state_hash"]);
}

TEST(RunFolder, ReplacesARunAndNothingElse) {
  const TemporaryFolder folder;
  const std::string run = "run cuboid-sine --level 3 --plots off --out run --ticks ";
  ASSERT_EQ(run_program(folder, run + "20").exit_code, 0);
  ASSERT_EQ(run_program(folder, run + "30").exit_code, 0);
  EXPECT_EQ(summary_of(folder, "run")["ticks"], 30);
  write_text(folder / "run/thesis.txt", "years of work");
  const Outcome outcome = run_program(folder, run + "40");
  EXPECT_EQ(outcome.exit_code, 2);
  expect_one_line(outcome.err);
  EXPECT_EQ(summary_of(folder, "run")["ticks"], 30);
  EXPECT_EQ(read_text(folder / "run/thesis.txt"), "years of work");
}

TEST(RunFolder, FileAndFlagsAreTheSameKeys) {
  const TemporaryFolder folder;
  write_text(folder / "soft.toml",
             "scenario = 'cuboid-sine'\nlevel = 3\nticks = 40\nplots = false\nout = 'file'\nslow = 2\n"
             "node = [64, 0, 192]\n[[region]]\nyoungs_modulus_pa = 900\n");
  ASSERT_EQ(run_program(folder, "run soft.toml").exit_code, 0);
  ASSERT_EQ(
      run_program(folder,
                  "run cuboid-sine --level 3 --ticks 40 --plots off --out flags --slow 2 --node-mm 64,0,192 "
                  "--youngs-modulus-pa 900")
          .exit_code,
      0);
  EXPECT_EQ(read_text(folder / "file/hash.csv"), read_text(folder / "flags/hash.csv"));
  EXPECT_EQ(summary_of(folder, "file")["parameters"], summary_of(folder, "flags")["parameters"]);
  // A flag wins over the file.
  ASSERT_EQ(run_program(folder, "run soft.toml --slow 3").exit_code, 0);
  EXPECT_EQ(summary_of(folder, "file")["parameters"]["slow"], 3);
}

TEST(RunFolder, EveryProfileRuns) {
  const TemporaryFolder folder;
  for (const char* profile : {"cuboid-paper", "cuboid-dense", "organ", "small", "tiny", "workstation"}) {
    const Outcome outcome = run_program(
        folder,
        std::string("hil grasp --ticks 5 --density-kg-m3 1000 --plots off --out run --profile ") + profile);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(summary_of(folder, "run")["profile"], profile);
  }
}

TEST(RunFolder, BendThatDoesNotSettleSaysSo) {
  const TemporaryFolder folder;
  const Outcome outcome = run_program(folder, "run cuboid-bend --level 3 --ticks 30 --plots off --out run");
  EXPECT_EQ(outcome.exit_code, 1);
  expect_one_line(outcome.err);
  EXPECT_NE(outcome.err.find("did not come to rest within 30 ticks"), std::string::npos) << outcome.err;
}

/// Node's column of nodes.csv at a rest position.
std::array<double, 3> node_at(const TemporaryFolder& folder, const std::string& rest) {
  for (const std::string& line : lines_of(read_text(folder / "run/nodes.csv"))) {
    const auto found = line.find("," + rest + ",");
    if (found == std::string::npos) continue;
    std::array<double, 3> at{};
    std::istringstream cells(line.substr(found + rest.size() + 2));
    for (double& value : at) {
      cells >> value;
      cells.ignore();
    }
    return at;
  }
  ADD_FAILURE() << "no node rests at " << rest;
  return {};
}

TEST(SlowRunFolder, SineReachesThePapersForce) {
  const TemporaryFolder folder;
  // The peak of the pull is at tick 3750; 1250 is the weaker push.
  const Outcome outcome = run_program(folder,
                                      "run cuboid-sine --rotations full --profile workstation "
                                      "--ticks 4000 --plots off --out run");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto summary = summary_of(folder, "run");
  EXPECT_NEAR(summary["peak_force_N"].get<double>(), 49.9e-3, 0.1e-3);
  EXPECT_EQ(summary["clamps"], nlohmann::json::parse(R"({"speed": 0, "position": 0, "strain": 0})"));
}

TEST(SlowRunFolder, BendComesToRestOnTheArc) {
  const TemporaryFolder folder;
  const Outcome outcome = run_program(folder, "run cuboid-bend --level 3 --substeps 2 --plots off --out run");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_LT(summary_of(folder, "run")["ticks"], 6000);
  // The end's corner (0, 0, 192): the face's centre is at radius R = 192 / (pi / 2), 32 mm outside it in z.
  const double radius = 192.0 / (M_PI / 2.0);
  const auto corner = node_at(folder, "0.000000,0.000000,192.000000");
  EXPECT_NEAR(corner[0], 0.0, 1e-4);
  EXPECT_NEAR(corner[1], 32.0 + radius, 1e-4);
  EXPECT_NEAR(corner[2], radius + 32.0, 1e-4);
}

}  // namespace
}  // namespace palpate::test
