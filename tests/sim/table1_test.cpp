// `table1`: its quick form holds and leaves its tables and pictures, and wrong input is refused.
#include <fmt/format.h>

#include <map>
#include <sstream>

#include "paper/published.hpp"
#include "paper/table1_output.hpp"
#include "program.hpp"
#include "text/split_at.hpp"

namespace palpate::test {
namespace {

using Row = std::map<std::string, std::string>;

std::vector<Row> read_csv(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> names = sim::split_at_commas(line);
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    const std::vector<std::string> cells = sim::split_at_commas(line);
    EXPECT_EQ(cells.size(), names.size()) << line;
    Row& row = rows.emplace_back();
    for (std::size_t i = 0; i < std::min(names.size(), cells.size()); ++i) row[names[i]] = cells[i];
  }
  return rows;
}

TEST(SlowTable1, QuickRowsHold) {
  const TemporaryFolder folder;
  const Outcome outcome = run_program(folder, "table1 --quick --out table");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(outcome.out.find("holds"), std::string::npos) << outcome.out;
  for (const char* file :
       {"index.html", "table1_curves.svg", "table1_curves.csv", "fig6a_48.png", "fig6b.svg"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / "table" / file)) << file;
  }
  const std::vector<Row> rows = read_csv(read_text(folder / "table/table1.csv"));
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].at("part"), "l-fem");
  EXPECT_NEAR(std::stod(rows[0].at("stvk_average_mm")), sim::published::kLinear.average_mm, 0.1);
  EXPECT_EQ(rows[1].at("part"), "corotation");
  for (std::size_t i = 2; i < 4; ++i) {
    EXPECT_EQ(rows[i].at("part"), i == 2 ? "theta" : "count");
    EXPECT_EQ(rows[i].at("result"), "ok");
    EXPECT_LE(std::stod(rows[i].at("minimum_mm")), std::stod(rows[i].at("average_mm")));
    EXPECT_LE(std::stod(rows[i].at("average_mm")), std::stod(rows[i].at("maximum_mm")));
  }
  EXPECT_EQ(rows[2].at("theta_deg"), "8.1");
  EXPECT_LE(std::stoi(rows[3].at("rotation_tets")), std::stoi(rows[3].at("paper_tets")));
  EXPECT_LE(std::stod(rows[3].at("average_mm")), std::stod(rows[3].at("paper_average_mm")));
}

TEST(SlowTable1, TwistHasNoFiguresOfThePaper) {
  const TemporaryFolder folder;
  const Outcome outcome = run_program(folder, "table1 --quick --plots off --twist 60 --out table");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("twisted by 60 degrees"), std::string::npos) << outcome.out;
  EXPECT_FALSE(std::filesystem::exists(folder / "table/index.html"));
  const std::vector<Row> rows = read_csv(read_text(folder / "table/table1.csv"));
  ASSERT_EQ(rows.size(), 4u);
  for (const Row& row : rows) EXPECT_EQ(row.at("paper_average_mm"), "");
  EXPECT_LT(std::stod(rows[3].at("average_mm")), 0.5);
}

TEST(SlowTable1, FullCorotationIsTheReferences) {
  sim::StatusLine status;
  const sim::Scenario scenario = sim::bar_scenario(40.0, 30.0);
  const sim::BarReference bar(scenario);
  sim::BarRuns runs(scenario, status);
  const sim::RestRun& run = runs.run("full", 1.0);
  EXPECT_EQ(run.failure, std::nullopt);
  const sim::Distance error = bar.distance(bar.positions_of(run.fields), bar.full().x);
  EXPECT_LT(error.max_mm, 1e-3);
}

/// A table whose only row has this error, at the paper's count.
sim::Table1 table_with(double average_mm, const sim::published::Table1Column& column) {
  sim::Table1 table{};
  sim::RestRun run{};
  run.rotation_tets = column.rotation_tets;
  table.rows.push_back({sim::Table1Part::kCount, &column, run, {average_mm, average_mm, average_mm}, {}});
  return table;
}

TEST(Table1, ObjectsToMoreThanThePapersError) {
  for (const auto& column : sim::published::kTable1) {
    const double paper_mm = column.errors.average_mm;
    EXPECT_TRUE(find_objections(table_with(paper_mm, column)).empty());
    EXPECT_EQ(find_objections(table_with(paper_mm * 1.001, column)).size(), 1u);
  }
}

TEST(Table1, ObjectsToWhatIsNotAtRest) {
  sim::Table1 table = table_with(0.0, sim::published::kTable1[0]);
  table.rows[0].run.failure = "it moves";
  EXPECT_EQ(find_objections(table).size(), 1u);
  EXPECT_NE(table1_text(table).find("FAILED: not at rest"), std::string::npos);
}

TEST(Table1, RequiresNothingAtAnotherPose) {
  sim::Table1 table = table_with(100.0, sim::published::kTable1[0]);
  table.options.bend_deg = 45.0;
  EXPECT_TRUE(find_objections(table).empty());
}

TEST(Table1, MeetsTheGoalWithAQuarterOfThePapersError) {
  const auto& column = sim::published::kTable1[3];
  const double quarter_mm = column.errors.average_mm / 4.0;
  const sim::Table1 met = table_with(quarter_mm, column);
  const sim::Table1 missed = table_with(quarter_mm * 1.01, column);
  EXPECT_EQ(goal(met, met.rows[0]), sim::Verdict::kHolds);
  EXPECT_EQ(goal(missed, missed.rows[0]), sim::Verdict::kFails);
  const sim::Table1 small = table_with(quarter_mm, sim::published::kTable1[2]);
  EXPECT_EQ(goal(small, small.rows[0]), sim::Verdict::kNone);
}

}  // namespace
}  // namespace palpate::test
