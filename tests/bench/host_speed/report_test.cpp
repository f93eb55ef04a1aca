// The report's forms say the same, and say what there is not.
#include "report.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace palpate::bench {
namespace {

Report sample() {
  Report report{};
  report.processor = "a processor";
  report.compiler = "a compiler";
  report.flags = "-O2";
  report.peer = "Bullet 1.2";
  report.rounds = 3;
  report.same_bits = true;
  report.rows = {{"ours", Work::kForces, "", 1000.0, 1, 1152, 18.0, {115.2, 57.6, 230.4}, 0.25, std::nullopt},
                 {"theirs", Work::kTick, "by magic", 10.0, 4, 1152, 1152.0, {1152.0, 1.0, 2.0}, 0.5, 1.5}};
  report.goals = {{"forces", 4.0, Figure{3.0, 2.0, 5.0}}, {"tick", 2.0, Figure{2.5, 2.0, 3.0}}};
  report.costs = {
      {288, 87, 18.0, {10, 9, 11}, {5, 4, 6}, {8, 7, 9}, Figure{20, 19, 21}, Figure{100, 90, 110}},
      {576, 187, 18.0, {20, 9, 11}, {9, 4, 6}, {16, 7, 9}, Figure{40, 19, 21}, Figure{200, 90, 110}}};
  return report;
}

Report without_peer() {
  Report report = sample();
  report.peer.reset();
  report.rows.pop_back();
  report.goals[0].ratio.reset();
  for (Cost& cost : report.costs) cost.peer_forces = cost.peer_step = std::nullopt;
  return report;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// The only line that begins so, blanks aside.
std::string line_of(const std::string& text, const std::string& begin) {
  std::string found;
  int count = 0;
  for (const std::string& line : lines_of(text)) {
    const auto start = line.find_first_not_of(' ');
    if (start == std::string::npos || line.compare(start, begin.size(), begin) != 0) continue;
    found = line;
    ++count;
  }
  EXPECT_EQ(count, 1) << begin;
  return found;
}

TEST(Report, ALineSaysAllOfARow) {
  const std::string text = report_text(sample());
  const std::string ours = line_of(text, "ours");
  for (const char* part : {" 18 ", " 115.2 ", " 100.0 ", "(50.0 .. 200.0)", " 25.00 %"}) {
    EXPECT_NE(ours.find(part), std::string::npos) << part << " in: " << ours;
  }
  const std::string theirs = line_of(text, "theirs");
  for (const char* part : {" 1152 ", " 4 ", " 10 ", " 1000.0 ", " 50.00 %", " 1.50 ", "by magic"}) {
    EXPECT_NE(theirs.find(part), std::string::npos) << part << " in: " << theirs;
  }
}

TEST(Report, GoalsAreMetOrNot) {
  const std::string text = report_text(sample());
  EXPECT_NE(line_of(text, "forces   ").find("goal    4    3.00 (2.00 .. 5.00)  not met"), std::string::npos);
  EXPECT_NE(line_of(text, "tick   ").find("goal    2    2.50 (2.00 .. 3.00)  met"), std::string::npos);
  const auto goals = report_json(sample())["goals"];
  EXPECT_EQ(goals[0]["is_met"], false);
  EXPECT_EQ(goals[1]["is_met"], true);
  EXPECT_EQ(goals[0]["ratio"]["median"], 3.0);
}

TEST(Report, JsonHasTheFigures) {
  const auto json = report_json(sample());
  EXPECT_EQ(json["peer"], "Bullet 1.2");
  EXPECT_EQ(json["rows"][0]["ns_per_tet"]["median"], 100.0);
  EXPECT_EQ(json["rows"][0]["us"]["low_quartile"], 57.6);
  EXPECT_TRUE(json["rows"][0]["distance_mm"].is_null());
  EXPECT_EQ(json["rows"][1]["integrator"], "by magic");
  EXPECT_EQ(json["rows"][1]["density_kg_m3"], 10.0);
  EXPECT_EQ(json["rows"][1]["distance_mm"], 1.5);
  EXPECT_EQ(json["costs"][1]["peer_step_us"]["median"], 200.0);
}

TEST(Report, WithoutAPeerItSaysSo) {
  const Report report = without_peer();
  const std::string text = report_text(report);
  EXPECT_NE(text.find("install libbullet-dev"), std::string::npos);
  EXPECT_NE(line_of(text, "forces   ").find("not measured"), std::string::npos);
  const auto json = report_json(report);
  EXPECT_TRUE(json["peer"].is_null());
  EXPECT_TRUE(json["goals"][0]["ratio"].is_null());
  EXPECT_TRUE(json["goals"][0]["is_met"].is_null());
  EXPECT_TRUE(json["costs"][0]["peer_step_us"].is_null());
  EXPECT_EQ(lines_of(cost_csv(report))[1], "288,87,18.0,10.00,5.00,8.00,,");
  EXPECT_EQ(cost_chart(report, "cost.svg").series.size(), 3u);
}

TEST(Report, OtherBitsAreShouted) {
  Report report = sample();
  report.same_bits = false;
  EXPECT_NE(report_text(report).find("makes OTHER bits"), std::string::npos);
}

TEST(Report, CostsAsCsvAndChart) {
  const std::vector<std::string> lines = lines_of(cost_csv(sample()));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0],
            "tets,nodes,adaptive_rotations,full_tick_us,adaptive_tick_us,full_forces_us,bullet_step_us,"
            "bullet_forces_us");
  EXPECT_EQ(lines[2], "576,187,18.0,20.00,9.00,16.00,200.00,40.00");
  const sim::Chart chart = cost_chart(sample(), "cost.svg");
  EXPECT_EQ(chart.x.names, (std::vector<std::string>{"288", "576"}));
  EXPECT_EQ(chart.series.size(), 5u);
}

}  // namespace
}  // namespace palpate::bench
