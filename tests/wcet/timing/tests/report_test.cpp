// Figures as JSON, tables and a page; files that are read.
#include "timing/timing_report.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "refusal.hpp"
#include "support/temporary_folder.hpp"

namespace palpate::wcet::timing::test {
namespace {

ProfileTiming make_timing() {
  ProfileTiming timing;
  timing.name = "small";
  timing.row = {"Small", "m4", {168'000, {}, {}, {}, {}}, {900, 1500, 60, 60, 60}};
  timing.figures.instructions = 1000;
  timing.figures.cycles = 1'680'000;
  timing.figures.model = "a model";
  timing.figures.stages = {{"forces", "tick.hpp:60", 2, 10, 840'000}};
  timing.figures.functions = timing.figures.stages;
  timing.figures.blocks = {{"evaluate<T>", "forces.hpp:7", 100, 420'000, 420'000}};
  timing.figures.sections = {{".bss", 3000, 0}};
  timing.figures.pools = {{"state.leaf", "Leaf[]", 2000}};
  timing.figures.stack = {100, 36, 200};
  timing.boards = {{{"A board", "m4", 168, "Tiny", "x.toml"}, 168, 1'680'168}};
  return timing;
}

TEST(TimingReport, IsAListForPrograms) {
  ProfileTiming timing = make_timing();
  nlohmann::json row = make_json({timing})[0];
  EXPECT_EQ(row["profile"], "small");
  EXPECT_EQ(row["core"], "m4");
  EXPECT_EQ(row["bound_instructions"], 1000);
  EXPECT_EQ(row["bound_cycles"], 1'680'000);
  EXPECT_TRUE(row["max_observed_instructions"].is_null()) << "nobody has measured";
  EXPECT_TRUE(row["ratio"].is_null());
  EXPECT_EQ(row["stack_bytes"], 336);
  EXPECT_EQ(row["ram_bytes"], 3000);
  EXPECT_EQ(row["is_design_met"], false);
  EXPECT_DOUBLE_EQ(row["boards"][0]["bound_us"], 10'001);
  EXPECT_DOUBLE_EQ(row["boards"][0]["slack_us"], -9001);
  EXPECT_TRUE(row["formula"].is_null());
  timing.measured = Measurement{800, 75.5};
  row = make_json({timing})[0];
  EXPECT_EQ(row["max_observed_instructions"], 800);
  EXPECT_EQ(row["coverage_percent"], 75.5);
  EXPECT_DOUBLE_EQ(row["ratio"], 1.25);
}

TEST(TimingReport, SaysWhatIsNotMeasured) {
  ProfileTiming timing = make_timing();
  for (const std::string& text : {make_tables({timing}), make_markdown({timing}), make_page({timing}, {})}) {
    EXPECT_NE(text.find("not measured"), std::string::npos) << text;
    EXPECT_NE(text.find("1 680 000"), std::string::npos);
    EXPECT_NE(text.find("168 000"), std::string::npos);
    EXPECT_NE(text.find("not met"), std::string::npos);
  }
  EXPECT_NE(make_tables({timing}).find("DWT CYCCNT"), std::string::npos);
  timing.measured = Measurement{800, std::nullopt};
  EXPECT_EQ(make_tables({timing}).find("not measured"), std::string::npos);
}

TEST(TimingReport, PageNeedsNothingElse) {
  ProfileTiming timing = make_timing();
  timing.formula = Formula{1000, {{"leaves", 288, 2000}}};
  const std::string page = make_page({timing}, {{true, "small on m4: grew"}});
  for (const char* part :
       {"evaluate&lt;T&gt;", "forces.hpp:7", "state.leaf", "small on m4: grew", "leaves", "50.0 %"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  for (const char* part : {"http:", "https:", "src=", "<script", "@import"})
    EXPECT_EQ(page.find(part), std::string::npos) << part;
}

TEST(TimingReport, GroupsDigits) {
  EXPECT_EQ(grouped(7), "7");
  EXPECT_EQ(grouped(1234), "1 234");
  EXPECT_EQ(grouped(-123456), "-123 456");
  EXPECT_EQ(grouped(1234567), "1 234 567");
}

class TimingFiles : public testing::Test {
 protected:
  std::string write(const std::string& text) {
    std::ofstream(path_) << text;
    return path_;
  }
  palpate::test::TemporaryFolder folder_;
  std::string path_ = folder_ / "file";
};

TEST_F(TimingFiles, Measurement) {
  EXPECT_FALSE(read_measurement(folder_ / "none"));
  EXPECT_EQ(read_measurement(write(R"({"max_observed_instructions": 12, "coverage_percent": 3.5})"))
                ->max_observed_instructions,
            12);
  EXPECT_THROW(read_measurement(write("{}")), BadInput);
  EXPECT_THROW(read_measurement(write("{")), BadInput);
  EXPECT_THROW(read_measurement(write(R"({"max_observed_instructions": "many"})")), BadInput);
}

constexpr const char* kFigures =
    "[[profile]]\nprofile = \"Small\"\ncore = \"m4\"\ndesign = { cycles = 168_000 }\n"
    "committed = { instructions = 1, cycles = 2, ram_bytes = 3, tick_code_bytes = 4, stack_bytes = 5 }\n"
    "# a remark\n[[board]]\nname = \"A\"\ncore = \"m4\"\nclock_mhz = 168\nprofile = \"Tiny\"\ndevices = "
    "\"a.toml\"\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST_F(TimingFiles, Figures) {
  const FigureFile file = read_figures(write(kFigures));
  ASSERT_EQ(file.rows.size(), 1u);
  EXPECT_EQ(*file.rows[0].design.cycles, 168'000);
  EXPECT_FALSE(file.rows[0].design.ram_bytes);
  EXPECT_EQ(file.rows[0].committed.stack_bytes, 5);
  EXPECT_EQ(file.boards[0].clock_mhz, 168);
  EXPECT_THROW(read_figures(write("none")), BadInput);
  EXPECT_THROW(read_figures(write("")), BadInput);
  EXPECT_THROW(read_figures(write(replaced(kFigures, "cycles = 2", "cycles = 0"))), BadInput);
  EXPECT_THROW(read_figures(write(replaced(kFigures, "168_000", "\"many\""))), BadInput);
  EXPECT_THROW(read_figures(write(replaced(kFigures, "ram_bytes = 3,", ""))), BadInput);
  EXPECT_THROW(read_figures(write(replaced(kFigures, "core = \"m4\"", ""))), BadInput);
  EXPECT_THROW(read_figures(write(replaced(kFigures, "clock_mhz = 168", ""))), BadInput);
}

TEST_F(TimingFiles, FiguresAreCommittedInPlace) {
  std::vector<FigureRow> rows = read_figures(write(kFigures)).rows;
  rows[0].committed = {10, 20, 30, 40, 50};
  const std::string text = with_committed(kFigures, rows);
  EXPECT_NE(text.find("# a remark"), std::string::npos);
  EXPECT_EQ(read_figures(write(text)).rows[0].committed.cycles, 20);
  rows[0].core = "m7";
  EXPECT_THROW(with_committed(kFigures, rows), BadInput);
}

}  // namespace
}  // namespace palpate::wcet::timing::test
