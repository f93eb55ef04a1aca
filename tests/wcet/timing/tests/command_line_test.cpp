// palpate-timing as people call it with what it can't use.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>

#include "support/temporary_folder.hpp"

namespace palpate::wcet::timing::test {
namespace {

class TimingProgram : public testing::Test {
 protected:
  int run(const std::string& arguments) {
    const std::string output = folder_ / "output";
    const int status =
        std::system((PALPATE_TIMING_PROGRAM " " + arguments + " >" + output + " 2>&1").c_str());
    std::ifstream file(output);
    text_.assign(std::istreambuf_iterator<char>(file), {});
    return WEXITSTATUS(status);
  }

  palpate::test::TemporaryFolder folder_;
  std::string text_;
};

TEST_F(TimingProgram, SaysWhichImageIsMissing) {
  const std::string nowhere = folder_ / "nowhere";
  EXPECT_EQ(run("check --m4 " + nowhere + " --core m4"), 2);
  EXPECT_NE(
      text_.find(
          "palpate_timing_Small.elf is not there: cmake --build --preset m4 --target palpate_timing_Small"),
      std::string::npos)
      << text_;
  EXPECT_EQ(run("report --m4 " + nowhere + " --m7 " + nowhere + " --out " + nowhere), 2);
  EXPECT_FALSE(std::filesystem::exists(nowhere)) << "nothing half-written";
}

TEST_F(TimingProgram, HasExitCodes) {
  EXPECT_EQ(run(""), 2);
  EXPECT_EQ(run("report"), 2);
  EXPECT_EQ(run("check --core m5"), 2);
  EXPECT_NE(text_.find("has no profile on m5"), std::string::npos) << text_;
  EXPECT_EQ(run("check --figures /no/such/file"), 2);
  EXPECT_EQ(run("--help"), 0);
  EXPECT_NE(text_.find("GPL"), std::string::npos);
  std::ofstream(folder_ / "figures.toml") << "[[profile]]\n";
  EXPECT_EQ(run("check --figures " + std::string(folder_ / "figures.toml")), 2);
  EXPECT_NE(text_.find("figures.toml has a row without profile"), std::string::npos) << text_;
}

}  // namespace
}  // namespace palpate::wcet::timing::test
