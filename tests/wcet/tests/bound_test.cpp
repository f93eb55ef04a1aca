// Bounds that can be counted by hand.
#include <gtest/gtest.h>

#include "../bound.hpp"
#include "../stack.hpp"
#include "../worst_path.hpp"
#include "cross_compiler.hpp"

namespace palpate::wcet::test {
namespace {

struct Analysis {
  explicit Analysis(const std::string& source, const std::string& model = "instructions")
      : target(kShorthands + source),
        calls(target.program(), target.entry_of("root")),
        cost_model(read_cost_model(model)),
        bounds(target.program(), calls, cost_model) {}
  TargetProgram target;
  CallGraph calls;
  CostModel cost_model;
  BoundAnalysis bounds;
};

Cycles bound_of(const std::string& source, const std::string& model = "instructions") {
  return Analysis(source, model).bounds.bound();
}

std::string assembler(const std::string& code) {
  return "ASSEMBLER void root() { asm volatile(" + code + "); }";
}

TEST(Bound, BranchFreeCodeIsExact) {
  EXPECT_EQ(bound_of(assembler("\"adds r0, #1\\n\\tmul r0, r0, r1\\n\\tstr r0, [r2]\\n\\tbx lr\"")), 4);
}

TEST(Bound, TakesTheLongerWay) {
  EXPECT_EQ(bound_of(assembler("\"cbz r0, 1f\\n\\tnop\\n\\tnop\\n\\tbx lr\\n1: nop\\n\\tbx lr\"")), 4);
}

TEST(Bound, PredicatedInstructionsCountAlways) {
  EXPECT_EQ(bound_of(assembler("\"cmp r0, #0\\n\\tite eq\\n\\tmoveq r0, #1\\n\\tmovne r0, #2\\n\\tbx lr\"")),
            5);
}

TEST(Bound, FollowsAPredicatedReturn) {
  EXPECT_EQ(bound_of(assembler("\"cmp r0, #0\\n\\tit eq\\n\\tbxeq lr\\n\\tnop\\n\\tbx lr\"")), 5);
}

TEST(Bound, BackwardBranchWithoutLoop) {
  EXPECT_EQ(
      bound_of(assembler("\"b 2f\\n1: adds r0, #1\\n\\tbx lr\\n2: cmp r0, #0\\n\\tbeq 1b\\n\\tbx lr\"")), 5);
}

TEST(Bound, BranchTable) {
  const std::string code =
      "\"tbb [pc, r0]\\n3: .byte (1f - 3b) / 2, (2f - 3b) / 2, (1f - 3b) / 2\\n\\t.align 1\\n"
      "1: bx lr\\n2: nop\\n\\tnop\\n\\tbx lr\"";
  EXPECT_EQ(bound_of(assembler(code)), 4);
}

// As gcc and as clang fill up what is behind an odd number of offsets.
TEST(Bound, BranchTableWithFiller) {
  const std::string ways = "\\n1: bx lr\\n2: nop\\n\\tnop\\n\\tbx lr\"";
  const std::string bytes = "\"tbb [pc, r0]\\n3: .byte (1f - 3b) / 2, (2f - 3b) / 2, (1f - 3b) / 2, ";
  EXPECT_EQ(bound_of(assembler(bytes + "0" + ways)), 4);
  EXPECT_EQ(bound_of(assembler(bytes + "0, 0, 0xbf" + ways)), 4);
  const std::string half_words = "\"tbh [pc, r0, lsl #1]\\n3: .short (1f - 3b) / 2, (2f - 3b) / 2, ";
  EXPECT_EQ(bound_of(assembler(half_words + "0xbf00" + ways)), 4);
}

TEST(Bound, TableOfAddresses) {
  const std::string code =
      "\"adr r2, 3f\\n\\tldr.w pc, [r2, r0, lsl #2]\\n\\t.align 2\\n3: .word 1f + 1, 2f + 1, 1f + 1\\n"
      "1: bx lr\\n2: nop\\n\\tnop\\n\\tbx lr\"";
  EXPECT_EQ(bound_of(assembler(code)), 5);
}

// As a linker reaches far code.
TEST(Bound, Veneer) {
  const std::string source =
      "ASSEMBLER void target() { asm volatile(\"nop\\n\\tbx lr\"); }\n"
      "ASSEMBLER void veneer() { asm volatile(\"ldr.w pc, [pc, #0]\\n\\t.word target\"); }\n"
      "ASSEMBLER void root() { asm volatile(\"push {r4, lr}\\n\\tbl veneer\\n\\tpop {r4, pc}\"); }";
  EXPECT_EQ(bound_of(source), 3 + 1 + 2);
}

// Entry, 3 instructions a round, and what is around it.
TEST(Bound, LoopWithAFact) {
  const std::string code =
      "FACT(1, 5, 10) \"movs r0, #10\\n1:\\n\\t\" FACT(2, 5, 10) \"subs r0, #1\\n\\tbne 1b\\n\\tbx lr\"";
  EXPECT_EQ(bound_of(assembler(code)), 2 + 10 * 3 + 1);
}

// Two bodies a round, as an unrolled loop has them, are still ten bodies.
TEST(Bound, UnrolledLoop) {
  const std::string code =
      "FACT(1, 5, 10) \"movs r0, #10\\n1:\\n\\t\" FACT(2, 5, 10) FACT(2, 5, 10) \"subs r0, #2\\n\\tbne "
      "1b\\n\\tbx lr\"";
  EXPECT_EQ(bound_of(assembler(code)), 2 + 5 * 4 + 1);
}

// 4 rounds of an outer loop; the inner loop's 3 rounds each are 6 in all by its total.
TEST(Bound, TotalAcrossNesting) {
  const std::string code =
      "FACT(1, 5, 4) \"1:\\n\\t\" FACT(2, 5, 4) FACT(1, 6, 3) \"2:\\n\\t\" FACT(2, 6, 3) \"subs r0, "
      "#1\\n\\tbne 2b\\n\\t\" "
      "\"subs r1, #1\\n\\tbne 1b\\n\\tbx lr\\n\\t\" "
      "\".pushsection .wcet.flowfacts,\\\"?\\\",%progbits\\n\\t.word 3, 6, 5, 6\\n\\t.popsection\"";
  EXPECT_EQ(bound_of(assembler(code)), 1 + 4 * 4 + 6 * 3 + 1);
}

TEST(Bound, CallsAndTailCalls) {
  const std::string source =
      "ASSEMBLER void leaf() { asm volatile(\"nop\\n\\tbx lr\"); }\n"
      "ASSEMBLER void root() { asm volatile(\"push {r4, lr}\\n\\tbl leaf\\n\\tpop {r4, lr}\\n\\tb.w leaf\"); "
      "}";
  EXPECT_EQ(bound_of(source), 4 + 2 + 2);
}

TEST(Bound, ListedIndirectCall) {
  const std::string source =
      "ASSEMBLER void shorter() { asm volatile(\"bx lr\"); }\n"
      "ASSEMBLER void longer() { asm volatile(\"nop\\n\\tnop\\n\\tbx lr\"); }\n"
      "ASSEMBLER void root() { asm volatile(\"push {r4, lr}\\n\\t\" FACT(4, shorter, 0) FACT(4, longer, 0)\n"
      "  \"blx r0\\n\\tpop {r4, pc}\"); }";
  EXPECT_EQ(bound_of(source), 5 + 3);
}

// A path that gives up is over; what the callee does for ever has no bound and needs none.
TEST(Bound, CallsThatNeverReturnEndAPath) {
  const std::string source =
      "ASSEMBLER void give_up() { asm volatile(\"1: b 1b\"); }\n"
      "ASSEMBLER void root() { asm volatile(\"cbz r0, 1f\\n\\tnop\\n\\tbx lr\\n1: bl give_up\"); }";
  const Analysis analysis(source);
  EXPECT_EQ(analysis.bounds.bound(), 3);
  EXPECT_EQ(analysis.calls.path_ends().size(), 1u);
}

// Its bodies are in a function that does not make the total: 20 of them in all, whatever calls it how often.
TEST(Bound, TotalThatACalleeTakesFrom) {
  const Analysis analysis(
      std::string(kBoundedLoops) +
      "struct Place {};\nusing Total = BoundedTotal<20, Place>;\n"
      "CASE void take_from(Total& total, uint32_t n) { for (const uint32_t i : total.take(0, n)) { (void)i; "
      "keep(); } }\n"
      "CASE void root(uint32_t n) {\n"
      "  Total total = bounded_total<20>(Place{});\n"
      "  for (const uint32_t i : bounded<7>(n, [] {})) { (void)i; take_from(total, n); }\n}");
  const WorstPath path = walk_worst_path(analysis.calls, analysis.bounds);
  const size_t callee = analysis.calls.index_of(analysis.target.entry_of("take_from"));
  EXPECT_TRUE(analysis.bounds.functions()[callee].is_open);
  EXPECT_DOUBLE_EQ(path.functions[callee].calls, 7);
  EXPECT_LT(analysis.bounds.bound(), 7 * 40 + 20 * 8);
  EXPECT_DOUBLE_EQ(path.functions.back().own + path.functions[callee].own,
                   static_cast<double>(analysis.bounds.bound()));
}

TEST(Bound, SharesAddUpToTheBound) {
  const Analysis analysis(std::string(kBoundedLoops) +
                              "CASE void inner(uint32_t n) { for (const uint32_t i : bounded<9>(n, [] {})) { "
                              "(void)i; keep(); } }\n"
                              "CASE void root(uint32_t n) { for (const uint32_t i : bounded<7>(n, [] {})) { "
                              "(void)i; inner(n); } }",
                          "m4");
  const WorstPath path = walk_worst_path(analysis.calls, analysis.bounds);
  double sum = 0;
  for (const FunctionFigures& figures : path.functions) sum += figures.own;
  EXPECT_DOUBLE_EQ(sum, static_cast<double>(analysis.bounds.bound()));
  double blocks = 0;
  for (const BlockFigures& figures : path.blocks) blocks += figures.own;
  EXPECT_DOUBLE_EQ(blocks, sum);
}

TEST(Stack, OfFramesAndChains) {
  const TargetProgram target(
      std::string(kShorthands) +
      "ASSEMBLER void leaf() { asm volatile(\"sub sp, #24\\n\\tadd sp, #24\\n\\tbx lr\"); }\n"
      "ASSEMBLER void root() { asm volatile(\"push {r4, r5, lr}\\n\\tsub sp, #4\\n\\tbl leaf\\n\\t\"\n"
      "  \"add sp, #4\\n\\tpop {r4, r5, lr}\\n\\tb.w leaf\"); }");
  const CallGraph calls(target.program(), target.entry_of("root"));
  const std::vector<StackUse> stack = measure_stack(target.program(), calls);
  EXPECT_EQ(stack.front().own_bytes, 24u);
  EXPECT_EQ(stack.back().own_bytes, 16u);
  EXPECT_EQ(stack.back().deepest_bytes, 40u);
}

// The interrupt may come where the background is deepest; the processor keeps nine words at most.
TEST(Stack, OfAnInterruptOnTopOfTheBackground) {
  const TargetProgram target(
      std::string(kShorthands) +
      "ASSEMBLER void memcpy() { asm volatile(\"push {r4, r5, r6, lr}\\n\\tpop {r4, r5, r6, pc}\"); }\n"
      "ASSEMBLER void background() { asm volatile(\"push {r4, lr}\\n\\tbl memcpy\\n\\tbl wait\"); }\n"
      "ASSEMBLER void wait() { asm volatile(\"push {r4, r5, r6, r7, r8, lr}\\n1: wfi\\n\\tb 1b\"); }\n"
      "ASSEMBLER void handler() { asm volatile(\"push {r4, r5, lr}\\n\\tpop {r4, r5, pc}\"); }");
  const InterruptedStack stack = measure_interrupted_stack(target.program(), "background", "handler");
  EXPECT_EQ(stack.background, 8u + 24u) << "also of what never comes back";
  EXPECT_EQ(stack.frame, 36u);
  EXPECT_EQ(stack.interrupt, 12u);
  EXPECT_EQ(stack.bytes(), 80u);
}

}  // namespace
}  // namespace palpate::wcet::test
