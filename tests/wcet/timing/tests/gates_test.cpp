// What fails, what is only said, and what the change log can say.
#include "timing/gates.hpp"

#include <gtest/gtest.h>

namespace palpate::wcet::timing::test {
namespace {

constexpr const char* kNoLog = "# Changelog\n\n## 0.2.0\n\n- Something.\n";

ProfileTiming make_timing(Cycles instructions, Cycles cycles) {
  ProfileTiming timing;
  timing.name = "small";
  timing.row = {"Small", "m4", {1000, 500, 64, 64, 64}, {400, 900, 60, 60, 60}};
  timing.figures.instructions = instructions;
  timing.figures.cycles = cycles;
  timing.figures.sections = {{".bss", 60, 0}, {".text", 0, 60}};
  timing.figures.tick_code_bytes = 60;
  timing.figures.stack = {20, 20, 20};
  return timing;
}

size_t failures_of(const ProfileTiming& timing, const std::string& changelog = kNoLog) {
  size_t failures = 0;
  for (const Finding& finding : judge(timing, changelog)) failures += finding.is_failure ? 1 : 0;
  return failures;
}

std::string text_of(const ProfileTiming& timing, const std::string& changelog = kNoLog) {
  std::string text;
  for (const Finding& finding : judge(timing, changelog)) text += finding.text + "\n";
  return text;
}

TEST(Gates, AGoalIsOnlySaid) {
  EXPECT_EQ(failures_of(make_timing(400, 900)), 0u);
  EXPECT_EQ(text_of(make_timing(400, 900)), "small on m4: goal not met: 900 cycles of 500\n");
}

TEST(Gates, ABoardsOwnProfileFitsAMillisecond) {
  ProfileTiming timing = make_timing(400, 500);
  timing.boards = {{{"A board", "m4", 168, "Small", "x.toml"}, 0, 168'000}};
  EXPECT_EQ(failures_of(timing), 0u);
  timing.boards[0].cycles = 168'001;
  EXPECT_EQ(failures_of(timing), 1u);
  timing.boards[0].board.profile = "Tiny";
  EXPECT_EQ(failures_of(timing), 0u) << "another one is only reported";
}

TEST(Gates, GrowthNeedsALine) {
  EXPECT_EQ(failures_of(make_timing(408, 918)), 0u) << "2 %";
  EXPECT_EQ(failures_of(make_timing(400, 919)), 1u);
  EXPECT_EQ(failures_of(make_timing(409, 900)), 1u);
  const ProfileTiming grown = make_timing(409, 950);
  EXPECT_NE(text_of(grown).find("- Timing: small on m4: 950 cycles, 409 instructions"), std::string::npos)
      << text_of(grown);
  EXPECT_EQ(failures_of(grown, "## next\n- Timing: small on m4: 950 cycles, 409 instructions\n## 0.1\n"), 0u);
  EXPECT_EQ(failures_of(grown, "## next\n- Contact. Timing: small on m4: 9 50 cycles, 409 instructions.\n"),
            0u);
  EXPECT_EQ(failures_of(grown, "## next\n- Timing: small on m4: 920 cycles, 409 instructions\n"), 1u)
      << "it says less than it is";
  EXPECT_EQ(failures_of(grown, "## next\n- Timing: small on m7: 950 cycles, 409 instructions\n"), 2u);
  EXPECT_EQ(
      failures_of(grown, "## next\n- Other.\n## 0.1\n- Timing: small on m4: 950 cycles, 409 instructions\n"),
      2u)
      << "an old line";
}

TEST(Gates, AShrunkenBoundMayBeCommitted) {
  EXPECT_EQ(failures_of(make_timing(300, 800)), 0u);
  EXPECT_NE(text_of(make_timing(300, 800)).find("-25.0 % of the committed 400: palpate-timing commit"),
            std::string::npos);
}

// Once met, the design's bound is a gate; before that it is a report.
TEST(Gates, TheDesignHoldsOnceItIsMet) {
  const std::string log = "## next\n- Timing: small on m4: 2000 cycles, 400 instructions\n";
  EXPECT_EQ(failures_of(make_timing(400, 1001), log), 1u);
  EXPECT_NE(text_of(make_timing(400, 1001), log).find("passes its design: 1 001 cycles of 1 000"),
            std::string::npos);
  ProfileTiming never = make_timing(400, 1500);
  never.row.committed.cycles = 1500;
  EXPECT_EQ(failures_of(never), 0u);
  EXPECT_NE(text_of(never).find("design not met yet: 1 500 cycles of 1 000"), std::string::npos);
  never.row.design = {};
  EXPECT_EQ(text_of(never), "") << "nothing is asked of it";
}

TEST(Gates, MemoryToo) {
  ProfileTiming timing = make_timing(400, 900);
  timing.figures.sections.front().ram = 65;
  timing.figures.tick_code_bytes = 65;
  timing.figures.stack.background = 25;
  EXPECT_EQ(failures_of(timing), 3u);
}

TEST(Gates, NothingIsSeenAboveABound) {
  ProfileTiming timing = make_timing(400, 900);
  timing.measured = Measurement{400, 80.0};
  EXPECT_EQ(failures_of(timing), 0u);
  timing.measured = Measurement{401, 80.0};
  EXPECT_EQ(failures_of(timing), 1u);
  EXPECT_NE(text_of(timing).find("401 instructions were seen"), std::string::npos);
}

TEST(Gates, TheFormulaIsTrue) {
  ProfileTiming timing = make_timing(400, 900);
  timing.formula = Formula{100, {{"leaves", 70, 10}, {"nodes", 10, 10}}};
  timing.formula_error = 0.009;
  EXPECT_EQ(failures_of(timing), 0u);
  timing.formula_error = 0.011;
  EXPECT_EQ(failures_of(timing), 1u);
  timing.formula = Formula{900, {}};
  EXPECT_EQ(failures_of(timing), 3u) << "it says nothing";
}

}  // namespace
}  // namespace palpate::wcet::timing::test
