// All that a tick can reach has a bound: palpate_loop_facts_test <firmware ELF> <ELF of
// loop_facts_cases.cpp>.
#include <gtest/gtest.h>

#include <cstdio>

#include "flow_check.hpp"

namespace palpate::target {
namespace {

std::string g_firmware;
std::string g_cases;

std::string join(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

std::string problems_of_case(const std::string& function) {
  static FlowCheck check(g_cases);
  return join(check.problems_below(function));
}

void expect_problem(const std::string& function, const std::string& part) {
  const std::string problems = problems_of_case(function);
  EXPECT_NE(problems.find(part), std::string::npos) << function << ": '" << problems << "'";
}

TEST(Decode, TellsConditionsFromLinks) {
  EXPECT_EQ(decode(0, "bls.n", "1c48 <f+0xdc>").flow, Flow::kJump);
  EXPECT_TRUE(decode(0, "bls.n", "1c48 <f+0xdc>").goes_on);
  EXPECT_EQ(decode(0, "cbz", "r0, 1c48 <f+0xdc>").target, 0x1c48u);
  EXPECT_EQ(decode(0, "bl", "1c48 <f>").flow, Flow::kCall);
  EXPECT_EQ(decode(0, "bics.w", "r0, r1, r2").flow, Flow::kPlain);
  EXPECT_FALSE(decode(0, "b.w", "1c48 <f>").goes_on);
}

TEST(Decode, KnowsReturns) {
  EXPECT_FALSE(decode(0, "pop", "{r4, pc}").goes_on);
  EXPECT_TRUE(decode(0, "popne", "{r4, pc}").goes_on);
  EXPECT_EQ(decode(0, "ldmia.w", "sp!, {r4, r5, pc}").flow, Flow::kEnd);
  EXPECT_EQ(decode(0, "ldmiaeq.w", "sp!, {r4, pc}").flow, Flow::kEnd);
  EXPECT_TRUE(decode(0, "ldmiaeq.w", "sp!, {r4, pc}").goes_on);
  EXPECT_EQ(decode(0, "ldr.w", "pc, [sp], #4").flow, Flow::kEnd);
  EXPECT_EQ(decode(0, "ldr.w", "pc, [r3, r0, lsl #2]").flow, Flow::kIndirect);
  EXPECT_EQ(decode(0, "bx", "r3").flow, Flow::kIndirect);
}

TEST(Checker, AcceptsBoundedLoops) {
  EXPECT_EQ(problems_of_case("palpate::cases::bounded_loops(unsigned long)"), "");
}

TEST(Checker, AcceptsLoopsThatShareATotal) {
  EXPECT_EQ(problems_of_case("palpate::cases::shared_total(unsigned long)"), "");
}

TEST(Checker, AcceptsABackwardBranchWithoutLoop) {
  EXPECT_EQ(problems_of_case("backward_branch_without_loop"), "");
}

TEST(Checker, FindsLoopsWithoutFact) {
  const std::string found = "loops without a flow fact";
  expect_problem("palpate::cases::loop_without_fact(unsigned long)", found);
  expect_problem("palpate::cases::outer_loop_without_fact(unsigned long)", found);
  expect_problem("palpate::cases::callee_without_fact(unsigned long)",
                 "loop_without_fact(unsigned long) at 0x");
  expect_problem(
      "palpate::cases::take_from_nobody(palpate::BoundedTotal<20ul, palpate::cases::NobodysPlace>&)", found);
  expect_problem("palpate::cases::total_in_a_loop_without_fact(unsigned long)", found);
  expect_problem("loop_past_a_predicated_return", found);
  expect_problem("loop_behind_a_table", found);
}

TEST(Checker, FindsRecursion) {
  expect_problem("palpate::cases::recursion(unsigned long)", "calls itself");
  expect_problem("palpate::cases::recursion_by_tail_calls(unsigned long)", "calls itself");
}

TEST(Checker, FindsWhatItCantFollow) {
  expect_problem("palpate::cases::indirect_call(void (*)())", "indirectly");
  expect_problem("computed_jump", "indirectly");
  expect_problem("palpate::cases::library_division(long long, long long)", "calls __aeabi_ldivmod");
  expect_problem("palpate::cases::library_copy(unsigned long*, unsigned long const*, unsigned long)",
                 "calls memcpy");
}

TEST(Tick, IsBounded) {
  FlowCheck check(g_firmware);
  for (const std::string& problem : check.problems_below("palpate::port::on_tick()"))
    ADD_FAILURE() << problem;
  std::printf("%zu functions, %zu loops with a flow fact\n", check.functions_reached(),
              check.loops_with_fact());
  EXPECT_GT(check.functions_reached(), 20u);
  EXPECT_GT(check.loops_with_fact(), 5u);
}

TEST(Background, IsNotBounded) {
  FlowCheck check(g_firmware);
  EXPECT_FALSE(check.problems_below("palpate::port::run_firmware()").empty()) << "it waits for ticks";
}

}  // namespace
}  // namespace palpate::target

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (argc != 3) {
    std::fprintf(stderr, "usage: palpate_loop_facts_test <firmware ELF> <ELF of the cases>\n");
    return 2;
  }
  palpate::target::g_firmware = argv[1];
  palpate::target::g_cases = argv[2];
  return RUN_ALL_TESTS();
}
