// The program as people call it: what it prints, and its exit codes.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cross_compiler.hpp"

namespace palpate::wcet::test {
namespace {

constexpr const char* kSource =
    "struct { unsigned leaf[400]; unsigned tick; } g_state; unsigned* volatile used = &g_state.tick;\n"
    "namespace tick_stages { __attribute__((noipa)) void forces() { asm volatile(\"nop\"); } }\n"
    "extern \"C\" __attribute__((noipa)) void root() { tick_stages::forces(); tick_stages::forces(); asm "
    "volatile(\"\"); }\n"
    "extern \"C\" __attribute__((noipa)) void endless() { for (;;) asm volatile(\"\"); }\n";

class CommandLine : public testing::Test {
 protected:
  int run(const std::string& arguments) {
    const std::string output = folder_ / "output";
    const int status = std::system((PALPATE_WCET_PROGRAM " " + arguments + " >" + output + " 2>&1").c_str());
    std::ifstream file(output);
    text_.assign(std::istreambuf_iterator<char>(file), {});
    return WEXITSTATUS(status);
  }

  palpate::test::TemporaryFolder folder_;
  TargetProgram target_{kSource};
  std::string text_;
};

TEST_F(CommandLine, ReportsStagesBlocksAndStack) {
  ASSERT_EQ(run(target_.path() + " --root root --model m4 --stack"), 0) << text_;
  for (const char* part :
       {"root: at most ", " cycles", "  forces\n", "program.cpp:", "stack: at most 8 bytes", ".text"}) {
    EXPECT_NE(text_.find(part), std::string::npos) << part << " in\n" << text_;
  }
}

TEST_F(CommandLine, ListsAnObjectByItsParts) {
  ASSERT_EQ(run(target_.path() + " --root root --model m4 --object g_state"), 0) << text_;
  EXPECT_NE(text_.find("1600  leaf: unsigned int[]"), std::string::npos) << text_;
  EXPECT_EQ(run(target_.path() + " --root root --model m4 --object g_other"), 2);
  EXPECT_NE(text_.find("has no object g_other"), std::string::npos) << text_;
}

TEST_F(CommandLine, WritesJson) {
  const std::string path = folder_ / "figures.json";
  ASSERT_EQ(run(target_.path() + " --root root --model m4 --interrupt --stack --json " + path), 0) << text_;
  const nlohmann::json figures = nlohmann::json::parse(std::ifstream(path));
  EXPECT_EQ(figures["interrupt"], 22);
  double sum = figures["interrupt"];
  for (const auto& function : figures["functions"]) sum += function["own"].get<double>();
  EXPECT_EQ(sum, figures["bound"].get<double>());
  EXPECT_EQ(figures["functions"][0]["stage"], "forces");
  EXPECT_EQ(figures["functions"][0]["count"], 2);
  EXPECT_EQ(figures["stack"]["bytes"], 8);
}

TEST_F(CommandLine, HasExitCodes) {
  EXPECT_EQ(run(target_.path() + " --root endless --model m4"), 1);
  EXPECT_NE(text_.find("palpate-wcet: endless at 0x"), std::string::npos) << text_;
  EXPECT_EQ(run(target_.path() + " --root nobody --model m4"), 2);
  EXPECT_EQ(run(target_.path() + " --root root --model m5"), 2);
  EXPECT_EQ(run(target_.path() + " --root root"), 2);
  EXPECT_EQ(run("nothing.elf --root root --model m4"), 2);
  EXPECT_EQ(run("/bin/true --root root --model m4"), 2);
  EXPECT_EQ(run(target_.path() + " --root root --model m4 --json /no/such/folder/figures.json"), 3);
  EXPECT_EQ(run("--help"), 0);
  EXPECT_NE(text_.find("GPL"), std::string::npos);
}

// palpate-measure, whose exact counts counting_test.cpp is about.
class MeasureCommandLine : public testing::Test {
 protected:
  int run(const std::string& options, const std::string& machine = "mps2-an386") {
    const std::string command = PALPATE_MEASURE_PROGRAM " " + target_.path() + " " + options + " --run " +
                                PALPATE_SOURCE_FOLDER "/board/mps2/run_in_qemu " + machine + " " +
                                target_.path();
    const std::string output = folder_ / "output";
    const int status = std::system((command + " >" + output + " 2>&1").c_str());
    std::ifstream file(output);
    text_.assign(std::istreambuf_iterator<char>(file), {});
    return WEXITSTATUS(status);
  }

  palpate::test::TemporaryFolder folder_;
  TargetProgram target_{
      std::string(kShorthands) +
      "CASE void root(uint32_t n) { if (n == 9) asm volatile(\"nop\\n\\tnop\\n\\tnop\\n\\tnop\"); }\n"
      "extern \"C\" __attribute__((noreturn, used)) void reset() {\n"
      "  root(1);\n"
      "  asm volatile(\"movs r0, #0x18\\n\\tldr r1, =0x20026\\n\\tbkpt 0xAB\\n\\t.ltorg\");\n"
      "  for (;;) asm volatile(\"\");\n}\n"
      "struct Vectors { uint32_t stack; void (*reset)(); };\n"
      "__attribute__((section(\".vectors\"), used)) const Vectors vectors{0x20400000, reset};\n"};
  std::string text_;
};

TEST_F(MeasureCommandLine, WritesJson) {
  const std::string path = folder_ / "figures.json";
  ASSERT_EQ(run("--root root --json " + path), 0) << text_;
  const nlohmann::json figures = nlohmann::json::parse(std::ifstream(path));
  EXPECT_EQ(figures["invocations"], 1);
  EXPECT_EQ(figures["bound_instructions"].get<int>(), figures["max_observed_instructions"].get<int>() + 4);
  EXPECT_EQ(figures["blocks"].get<int>(), figures["blocks_covered"].get<int>() + 1);
  ASSERT_EQ(figures["uncovered"].size(), 1u);
  EXPECT_EQ(figures["uncovered"][0]["function"], "root");
  EXPECT_NE(figures["uncovered"][0]["line"].get<std::string>().find("program.cpp:"), std::string::npos);
  EXPECT_TRUE(figures["edges_outside_graph"].empty());
}

TEST_F(MeasureCommandLine, HasGatesAndExitCodes) {
  EXPECT_EQ(run("--root root --most-ratio 5 --least-coverage 50"), 0) << text_;
  EXPECT_EQ(run("--root root --most-ratio 1.01"), 1);
  EXPECT_NE(text_.find("of the most that was seen"), std::string::npos) << text_;
  EXPECT_EQ(run("--root root --least-coverage 99"), 1);
  EXPECT_EQ(run("--root nobody"), 2);
  EXPECT_EQ(run(""), 2);
  EXPECT_EQ(run("--root root", "no-machine"), 3);
  EXPECT_EQ(run("--root root --plugin /no/such/plugin.so"), 3);
  EXPECT_EQ(run("--root root --json /no/such/folder/figures.json"), 3);
}

}  // namespace
}  // namespace palpate::wcet::test
