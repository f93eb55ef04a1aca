// What the plugin counts: programs whose counts are known by hand, and what QEMU's own clock says.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "../measure/counted_run.hpp"
#include "../measure/measurement.hpp"
#include "../measure/planning.hpp"
#include "../plugin/qemu_plugin.hpp"
#include "cross_compiler.hpp"
#include "generated_program.hpp"

namespace palpate::wcet::test {
namespace {

/// A program that calls root with 0, 1, 2 and ends.
constexpr const char* kRunner = R"(
extern "C" void root(uint32_t);
extern "C" __attribute__((noreturn, used)) void reset() {
  for (uint32_t i = 0; i < 3; ++i) root(i);
  asm volatile("movs r0, #0x18\n\tldr r1, =0x20026\n\tbkpt 0xAB\n\t.ltorg");
  for (;;) asm volatile("");
}
struct Vectors { uint32_t stack; void (*reset)(); };
__attribute__((section(".vectors"), used)) const Vectors vectors{0x20400000, reset};
)";

std::vector<std::string> in_qemu(const TargetProgram& target) {
  return {"timeout",
          "100",
          "qemu-system-arm",
          "-M",
          "mps2-an386",
          "-kernel",
          target.path(),
          "-display",
          "none",
          "-monitor",
          "none",
          "-serial",
          "none",
          "-semihosting",
          "-icount",
          "shift=10,align=off,sleep=off"};
}

/// With a root that is written as assembler, and what belongs to it.
struct CountedRun {
  explicit CountedRun(const std::string& source, const std::string& root = "root", const char* more = "")
      : target(std::string(kShorthands) + more + kRunner + source, "-O2"),
        calls(target.program(), target.entry_of(root)),
        bounds(target.program(), calls, read_cost_model("instructions")),
        counts(run_counted(in_qemu(target), PALPATE_COUNTING_PLUGIN,
                           make_plan(target.program(), calls, bounds))) {}
  [[nodiscard]] Measurement measurement() const { return measure(target.program(), calls, bounds, counts); }
  [[nodiscard]] std::vector<std::string> broken() const {
    return broken_gates(target.program(), measurement());
  }
  [[nodiscard]] uint64_t count_at(uint32_t offset) const {
    const auto found = counts.spots.find(target.entry_of("root") + offset);
    return found == counts.spots.end() ? 0 : found->second.all;
  }
  [[nodiscard]] uint64_t edges(uint32_t from, uint32_t to) const {
    const uint32_t root = target.entry_of("root");
    const auto found = counts.edges.find({root + from, root + to});
    return found == counts.edges.end() ? 0 : found->second;
  }
  TargetProgram target;
  CallGraph calls;
  BoundAnalysis bounds;
  Counts counts;
};

std::string root(const std::string& code) {
  return "ASSEMBLER void root(uint32_t) { asm volatile(" + code + "); }";
}

using Invocations = std::vector<uint64_t>;

// Two bodies for each of the argument: 1 (enter) + 1 + n (3 + 1) + 1 of leaving.
TEST(Counting, LoopByHand) {
  const CountedRun run(
      root("FACT(1, 5, 4) \"lsls r0, #1\\n1:\\n\\tcbz r0, 2f\\n\\t\" FACT(2, 5, 4) "
           "\"subs r0, #1\\n\\tb 1b\\n2: bx lr\""));
  EXPECT_EQ(run.counts.invocations, (Invocations{4, 12, 20}));
  EXPECT_EQ(run.count_at(0), 3u);
  EXPECT_EQ(run.count_at(4), 9u);   // cbz
  EXPECT_EQ(run.count_at(8), 6u);   // subs
  EXPECT_EQ(run.edges(4, 6), 6u);   // into the body
  EXPECT_EQ(run.edges(4, 12), 3u);  // out of the loop
  EXPECT_EQ(run.edges(10, 4), 6u);  // back
  const Measurement measurement = run.measurement();
  ASSERT_EQ(measurement.loops.size(), 1u);
  EXPECT_EQ(measurement.loops[0].seen.entries, 3u);
  EXPECT_EQ(measurement.loops[0].seen.bodies, 6u);
  EXPECT_EQ(measurement.loops[0].seen.most_rounds, 4u);
  EXPECT_EQ(measurement.longest_at, 2u);
  EXPECT_EQ(measurement.bound, 20);
  EXPECT_DOUBLE_EQ(measurement.ratio(), 1);
  EXPECT_DOUBLE_EQ(measurement.coverage_percent(), 100);
  EXPECT_EQ(run.broken(), std::vector<std::string>{});
}

// The fact says 3 and the loop runs 4 times: the bound is wrong then, and this is how it is found.
TEST(Counting, FindsALoopThatPassesItsFact) {
  const CountedRun run(
      root("FACT(1, 5, 3) \"lsls r0, #1\\n1:\\n\\tcbz r0, 2f\\n\\t\" FACT(2, 5, 3) "
           "\"subs r0, #1\\n\\tb 1b\\n2: bx lr\""));
  const std::vector<std::string> broken = run.broken();
  ASSERT_EQ(broken.size(), 3u);  // of the root, of the function, of the loop
  EXPECT_NE(broken[0].find("20 instructions in invocation 2, but the bound is 16"), std::string::npos)
      << broken[0];
  EXPECT_NE(broken[2].find("1 bodies more than its fact of 3"), std::string::npos) << broken[2];
}

// Calls, a tail call and a predicated return; with callees, a call of leaf takes 2.
TEST(Counting, CallsAndReturns) {
  const CountedRun run(
      "ASSEMBLER void leaf() { asm volatile(\"nop\\n\\tbx lr\"); }\n" +
      root("\"cmp r0, #1\\n\\tit eq\\n\\tbxeq lr\\n\\tpush {r4, lr}\\n\\tbl leaf\\n\\tbl leaf\\n\\t\" "
           "\"pop {r4, lr}\\n\\tb.w leaf\""));
  EXPECT_EQ(run.counts.invocations, (Invocations{14, 3, 14}));
  const FunctionCounts leaf = run.counts.functions.at(run.target.entry_of("leaf"));
  EXPECT_EQ(leaf.calls, 6u);
  EXPECT_EQ(leaf.most, 2u);
  EXPECT_EQ(leaf.most_in_invocation, 6u);
  EXPECT_EQ(run.counts.functions.at(run.target.entry_of("root")).most, 14u);
  EXPECT_EQ(run.broken(), std::vector<std::string>{});
  EXPECT_TRUE(run.measurement().uncovered.empty());
}

TEST(Counting, ListsWhatNeverRan) {
  const CountedRun run(root("\"cmp r0, #9\\n\\tbne 1f\\n\\tnop\\n\\tnop\\n1: bx lr\""));
  const Measurement measurement = run.measurement();
  ASSERT_EQ(measurement.uncovered.size(), 1u);
  EXPECT_EQ(measurement.uncovered[0].instructions, 2u);
  EXPECT_EQ(measurement.uncovered[0].place.address, run.target.entry_of("root") + 4);
  EXPECT_EQ(measurement.blocks, 3u);
}

// A total's bodies count for the function that makes it, whatever calls the one that they are in.
TEST(Counting, TotalsAcrossCalls) {
  const CountedRun run(
      "struct Place {};\nusing Total = BoundedTotal<20, Place>;\n"
      "CASE void take_from(Total& total, uint32_t n) { for (const uint32_t i : total.take(0, n)) { (void)i; "
      "keep(); } }\n"
      "CASE void root(uint32_t n) {\n"
      "  Total total = bounded_total<20>(Place{});\n"
      "  for (const uint32_t i : bounded<7>(7, [] {})) { (void)i; take_from(total, 2 * n); }\n}",
      "root", kBoundedLoops);
  const Measurement measurement = run.measurement();
  const auto total = std::find_if(measurement.loops.begin(), measurement.loops.end(),
                                  [](const LoopSeen& loop) { return loop.bound == 20; });
  ASSERT_NE(total, measurement.loops.end());
  EXPECT_EQ(total->seen.entries, 3u);
  EXPECT_EQ(total->seen.bodies, 0u + 14 + 20);
  EXPECT_EQ(total->seen.most_rounds, 20u);
  EXPECT_EQ(run.broken(), std::vector<std::string>{});
}

// The record of the call's targets has forgotten one.
TEST(Counting, FindsACallThatTheGraphDoesNotHave) {
  const CountedRun run(
      "ASSEMBLER void listed() { asm volatile(\"bx lr\"); }\n"
      "ASSEMBLER void forgotten() { asm volatile(\"bx lr\"); }\n" +
      root("\"push {r4, lr}\\n\\tldr r0, =forgotten\\n\\t\" FACT(4, listed, 0) \"blx r0\\n\\tpop {r4, "
           "pc}\\n\\t.ltorg\""));
  try {
    (void)run.measurement();
    FAIL() << "it was not found";
  } catch (const Refusal& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("where the graph does not lead"), std::string::npos);
  }
}

TEST(Counting, WantsAWholeRun) {
  const CountedRun run(root("\"movs r0, #0x18\\n\\tldr r1, =0x20026\\n\\tbkpt 0xAB\\n\\tbx lr\\n\\t.ltorg\"")
                           .replace(0, 0, "ASSEMBLER void other() { asm volatile(\"bx lr\"); }\n"),
                       "other");
  EXPECT_THROW((void)run.measurement(), RunFailed) << "the run never comes to it";
}

// Loaded without QEMU: none of its functions is called before all is right.
TEST(Counting, RefusesAnotherQemu) {
  void* plugin = dlopen(PALPATE_COUNTING_PLUGIN, RTLD_LAZY);
  ASSERT_NE(plugin, nullptr) << dlerror();
  const auto install = reinterpret_cast<decltype(&qemu_plugin_install)>(dlsym(plugin, "qemu_plugin_install"));
  ASSERT_NE(install, nullptr);
  const auto refuses = [install](const QemuInfo& qemu) {
    testing::internal::CaptureStderr();
    const bool is_refused = install(1, &qemu, 0, nullptr) != 0;
    const std::string why = testing::internal::GetCapturedStderr();
    return is_refused ? why : "not refused";
  };
  EXPECT_NE(refuses({"arm", {2, 3}, true, {1, 1}}).find("interface 2 to 3, and not 1"), std::string::npos);
  EXPECT_NE(refuses({"riscv32", {0, 1}, true, {1, 1}}).find("one Arm processor"), std::string::npos);
  EXPECT_NE(refuses({"arm", {0, 1}, true, {2, 2}}).find("one Arm processor"), std::string::npos);
  EXPECT_NE(refuses({"arm", {0, 1}, true, {1, 1}}).find("needs plan=FILE"), std::string::npos);
  dlclose(plugin);
}

// QEMU's clock counts the same instructions, whatever the program and the compiler's options.
class SameAsTheClock : public testing::TestWithParam<std::tuple<const char*, uint32_t>> {};

TEST_P(SameAsTheClock, InEveryRoot) {
  const auto [options, seed] = GetParam();
  const TargetProgram target(generate_program(seed),
                             std::string(options) + " -I" PALPATE_SOURCE_FOLDER "/tests/wcet/tests");
  std::string command;
  for (const std::string& word : in_qemu(target)) command += word + " ";
  std::istringstream clock(output_of(command + "</dev/null"));
  for (uint32_t i = 0; i < kRoots; ++i) {
    uint64_t most = 0;
    ASSERT_TRUE(clock >> most);
    const CallGraph calls(target.program(), target.entry_of("root_" + std::to_string(i)));
    const BoundAnalysis bounds(target.program(), calls, read_cost_model("instructions"));
    const Counts counts =
        run_counted(in_qemu(target), PALPATE_COUNTING_PLUGIN, make_plan(target.program(), calls, bounds));
    const Measurement measurement = measure(target.program(), calls, bounds, counts);
    EXPECT_EQ(measurement.longest, most) << "root_" << i;
    EXPECT_EQ(broken_gates(target.program(), measurement), std::vector<std::string>{}) << "root_" << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Options, SameAsTheClock,
                         testing::Values(std::make_tuple("-O1", 1u), std::make_tuple("-O2", 2u),
                                         std::make_tuple("-O3", 3u), std::make_tuple("-Os", 1u)));

}  // namespace
}  // namespace palpate::wcet::test
