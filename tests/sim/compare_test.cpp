// compare: equal runs, and where two runs part.
#include <sstream>

#include "program.hpp"

namespace palpate::test {
namespace {

class Compare : public testing::Test {
 protected:
  void SetUp() override {
    const std::string run = "hil grasp --level 3 --ticks 60 --hash-every 20 --plots off --out a";
    const Outcome outcome = run_program(folder_, run);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    std::filesystem::copy(folder_ / "a", folder_ / "b");
  }

  /// Replaces one hash digit in hash.csv of b.
  void change(uint32_t line_number, std::size_t column) {
    std::istringstream lines(read_text(folder_ / "b/hash.csv"));
    std::string changed;
    std::string line;
    for (uint32_t i = 0; std::getline(lines, line); ++i) {
      if (i == line_number) {
        std::size_t at = 0;
        for (std::size_t comma = 0; comma < column; ++comma) at = line.find(',', at) + 1;
        line[at] = line[at] == '0' ? '1' : '0';
      }
      changed += line + "\n";
    }
    write_text(folder_ / "b/hash.csv", changed);
  }

  /// What a target would print for run a.
  [[nodiscard]] std::string console_of_a() const {
    std::istringstream lines(read_text(folder_ / "a/hash.csv"));
    std::string line;
    std::getline(lines, line);
    const std::string last = ",state";
    std::string console = "stages" + line.substr(4, line.size() - 4 - last.size()) + "\n";
    while (std::getline(lines, line)) console += "hash," + line + "\n";
    return console + "summary,leaves,144\nsummary,peak_force_square,0000000000000000\nsummary,fault,0\n";
  }

  void use_console(const std::string& text) {
    std::filesystem::create_directory(folder_ / "target");
    write_text(folder_ / "target/console.csv", text);
  }

  void expect(const std::string& arguments, int exit_code, const std::string& part) {
    const Outcome outcome = run_program(folder_, "compare " + arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    const std::string text = outcome.out + outcome.err;
    EXPECT_NE(text.find(part), std::string::npos) << text;
  }

  TemporaryFolder folder_;
};

TEST_F(Compare, EqualRuns) { expect("a b", 0, "equal: all 8 stages at all 3 hashed ticks"); }

TEST_F(Compare, NamesTheFirstTickAndStage) {
  change(3, 2);
  change(2, 9);
  change(2, 5);
  expect("a b", 1, "first difference: tick 40, stage forces");
}

TEST_F(Compare, ReadsATargetsConsole) {
  use_console(console_of_a() + "end\n");
  expect("a target", 0, "equal: all 8 stages at all 3 hashed ticks");
  expect("target a", 0, "equal");
}

TEST_F(Compare, ToleratesCarriageReturns) {
  std::string text = console_of_a() + "end\n";
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 2))
    text.insert(at, "\r");
  use_console(text);
  expect("a target", 0, "equal");
}

TEST_F(Compare, SaysThatAConsoleIsCutOff) {
  use_console(console_of_a());
  expect("a target", 1, "is cut off");
}

TEST_F(Compare, SaysWhyATargetStopped) {
  use_console("error,the model is refused with status 1\nend\n");
  expect("a target", 1, "stopped: error,the model is refused with status 1");
}

TEST_F(Compare, ExplainsMissingTicks) {
  ASSERT_EQ(
      run_program(folder_, "hil grasp --level 3 --ticks 60 --hash-every 30 --plots off --out c").exit_code,
      0);
  expect("a c", 1, "c has no hashes of 2 ticks that a has, the first is 20");
  expect("a c", 1, "a has no hashes of 1 ticks that c has, the first is 30");
}

TEST_F(Compare, ExplainsDifferentStages) {
  ASSERT_EQ(run_program(folder_, "run cuboid-sine --level 3 --ticks 60 --plots off --out c").exit_code, 0);
  expect("a c", 1, "different stages");
}

TEST_F(Compare, RefusesDamagedFiles) {
  write_text(folder_ / "b/hash.csv", "tick,touch,state\n20,0123456789abcdef\n");
  expect("a b", 2, "hash.csv:2: the row has 1 hashes, but there are 2 stages");
  write_text(folder_ / "b/hash.csv", "tick,state\n20,0123456789abcdeg\n");
  expect("a b", 2, "'0123456789abcdeg' is no hash");
  write_text(folder_ / "b/hash.csv", "tick,state\n20,0123456789abcdef\n20,0123456789abcdef\n");
  expect("a b", 2, "tick 20 is there twice");
  write_text(folder_ / "b/hash.csv", "");
  expect("a b", 1, "has no hashes");
}

}  // namespace
}  // namespace palpate::test
