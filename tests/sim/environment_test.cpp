// What the environment refuses: exit code 3, one line, nothing half-written.
#include "program.hpp"

namespace palpate::test {
namespace {

// A few ticks of a coarse bar.
constexpr const char* kShortRun = "run cuboid-sine --level 3 --ticks 200 --plots off";

void expect_refused(const Outcome& outcome, const char* message) {
  EXPECT_EQ(outcome.exit_code, 3);
  expect_one_line(outcome.err);
  EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
}

TEST(Environment, FolderThatCannotBeMade) {
  const TemporaryFolder folder;
  write_text(folder / "file", "");
  expect_refused(run_program(folder, std::string(kShortRun) + " --out file/deeper/run"), "file/deeper/run");
  expect_refused(run_program(folder, std::string(kShortRun) + " --out /proc/palpate/run"),
                 "/proc/palpate/run");
  EXPECT_EQ(folder.contents(), std::vector<std::string>{"file"});
}

TEST(Environment, FullDisk) {
  const TemporaryFolder folder;
  expect_refused(run_program(folder, kShortRun, "ulimit -f 8;"), "cannot write");
  EXPECT_TRUE(folder.contents().empty());
}

TEST(Environment, FullDiskKeepsTheOlderRun) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program(folder, std::string(kShortRun) + " --out run").exit_code, 0);
  const auto before = folder.contents();
  const std::string summary = read_text(folder / "run/summary.json");
  expect_refused(run_program(folder, std::string(kShortRun) + " --slow 2 --out run", "ulimit -f 8;"),
                 "cannot write");
  EXPECT_EQ(folder.contents(), before);
  EXPECT_EQ(read_text(folder / "run/summary.json"), summary);
}

TEST(Environment, FullDeviceForTheImage) {
  const TemporaryFolder folder;
  expect_refused(run_program(folder, "model grasp --firmware-image /dev/full"), "No space left");
  expect_refused(run_program(folder, "model grasp --firmware-image nowhere/image.cpp"), "nowhere/image.cpp");
  expect_refused(run_program(folder, "model grasp --firmware-image image.cpp", "ulimit -f 8;"), "image.cpp");
  EXPECT_TRUE(folder.contents().empty());
}

TEST(Environment, FullStandardOutput) {
  const TemporaryFolder folder;
  const Outcome outcome = run_program(folder, "model grasp >/dev/full");
  expect_refused(outcome, "standard output");
}

TEST(Environment, NoGnuplot) {
  const TemporaryFolder folder;
  const Outcome outcome = run_program(folder, "run cuboid-sine --level 3 --ticks 100", "PATH=/nowhere;");
  expect_refused(outcome, "install gnuplot-nox, or use --plots off");
  EXPECT_TRUE(folder.contents().empty());
}

TEST(Environment, InterruptedRunLeavesNothing) {
  const TemporaryFolder folder;
  // The shell waits for the child that timeout ends, and returns 128 + SIGTERM.
  const Outcome outcome =
      run_program(folder, "run cuboid-sine --slow 100 --plots off", "exec timeout -s TERM 1");
  EXPECT_NE(outcome.exit_code, 0);
  expect_one_line(outcome.err);
  EXPECT_NE(outcome.err.find("interrupted"), std::string::npos) << outcome.err;
  EXPECT_TRUE(folder.contents().empty());
}

}  // namespace
}  // namespace palpate::test
