// The program as a child process, in haste: one round.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/temporary_folder.hpp"

namespace palpate::bench {
namespace {

std::string read_text(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

struct Outcome {
  int exit_code;
  std::string out, err;
};

Outcome run_program(const test::TemporaryFolder& folder, const std::string& arguments) {
  const std::string command = fmt::format("cd '{}' && '{}' {} >out.txt 2>err.txt", folder.path().string(),
                                          PALPATE_HOST_SPEED_PATH, arguments);
  const int status = std::system(command.c_str());
  return {WEXITSTATUS(status), read_text(folder / "out.txt"), read_text(folder / "err.txt")};
}

TEST(HostSpeedProgram, RefusesBadInputInALine) {
  const test::TemporaryFolder folder;
  for (const char* arguments : {"--rounds 0", "--rounds many", "--round 3"}) {
    const Outcome outcome = run_program(folder, arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_EQ(outcome.err.rfind("palpate_host_speed: ", 0), 0u) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(HostSpeedProgram, RefusesAFolderThatCannotBe) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "file") << "in the way";
  const Outcome outcome = run_program(folder, "--out file/bench");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("file/bench"), std::string::npos) << outcome.err;
}

/// The line of the table that a row of the JSON must be in.
std::string figures_of(const nlohmann::json& row) {
  const auto& ns = row["ns_per_tet"];
  return fmt::format("{:.1f} {:>7.1f}  ({:.1f} .. {:.1f})", row["us"]["median"].get<double>(),
                     ns["median"].get<double>(), ns["low_quartile"].get<double>(),
                     ns["high_quartile"].get<double>());
}

/// 18 rotations, 4.1 degrees, about 300 and one a tet, at 1 and 4 substeps.
void expect_rotations(const nlohmann::json& json) {
  for (const int substeps : {1, 4}) {
    std::vector<double> rotations;
    for (const auto& row : json["rows"]) {
      if (row["work"] == "tick" && row["substeps"] == substeps && row["integrator"] == "symplectic Euler") {
        rotations.push_back(row["rotations"]);
      }
    }
    ASSERT_EQ(rotations.size(), 5u) << substeps;
    EXPECT_EQ(rotations[0], 18.0);
    EXPECT_NEAR(rotations[2], 300.0, 30.0);
    EXPECT_EQ(rotations[3], 1152.0);
    EXPECT_EQ(rotations[4], 1152.0);
  }
}

TEST(HostSpeedProgram, WritesWhatItPrints) {
  const test::TemporaryFolder folder;
  const Outcome outcome = run_program(folder, "--rounds 1 --out bench");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(read_text(folder / "bench/bench.json"));
  EXPECT_EQ(json["same_bits"], true);
  EXPECT_EQ(json["rounds"], 1);
  EXPECT_GE(json["rows"].size(), 15u);
  expect_rotations(json);
  for (const auto& row : json["rows"]) {
    EXPECT_GT(row["us"]["median"], 0.0);
    EXPECT_NE(outcome.out.find(figures_of(row)), std::string::npos) << row;
  }
  EXPECT_EQ(json["goals"].size(), 3u);
  ASSERT_EQ(json["costs"].size(), 6u);
  EXPECT_EQ(json["costs"].front()["tets"], 288);
  EXPECT_EQ(json["costs"].back()["tets"], 9216);
  EXPECT_EQ(outcome.out.rfind(read_text(folder / "bench/bench.txt"), 0), 0u);
  const std::string csv = read_text(folder / "bench/cost.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7);
  EXPECT_NE(read_text(folder / "bench/cost.svg").find("</svg>"), std::string::npos);
}

}  // namespace
}  // namespace palpate::bench
