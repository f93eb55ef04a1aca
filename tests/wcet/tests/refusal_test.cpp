// What has no bound is refused, and the message says where it is.
#include <gtest/gtest.h>

#include "../bound.hpp"
#include "../stack.hpp"
#include "cross_compiler.hpp"

namespace palpate::wcet::test {
namespace {

void analyse(const TargetProgram& program, const std::string& root) {
  const CallGraph calls(program.program(), program.entry_of(root));
  measure_stack(program.program(), calls);
  const BoundAnalysis bounds(program.program(), calls, read_cost_model("instructions"));
}

std::string refusal_of(const std::string& source, const std::string& options = "-O2") {
  try {
    const TargetProgram program(kShorthands + source, options);
    analyse(program, "root");
  } catch (const Refusal& refusal) {
    return refusal.what();
  }
  return "";
}

void expect_refusal(const std::string& code, const std::string& why,
                    const std::string& where = "root at 0x") {
  const bool has_bounded_loops =
      code.find("bounded") != std::string::npos || code.find("Bounded") != std::string::npos;
  const std::string refusal = refusal_of(has_bounded_loops ? kBoundedLoops + code : code);
  EXPECT_NE(refusal.find(why), std::string::npos) << "'" << refusal << "'";
  EXPECT_EQ(refusal.find(where), 0u) << "'" << refusal << "'";
  EXPECT_NE(refusal.find("program.cpp:"), std::string::npos) << "'" << refusal << "'";
}

TEST(Refusal, LoopWithoutFact) {
  expect_refusal("CASE void root(uint32_t n) { for (uint32_t i = 0; i < n; ++i) keep(); }",
                 "a loop without a flow fact");
}

TEST(Refusal, NamesTheLineOfALoop) {
  const std::string refusal =
      refusal_of("CASE void root(uint32_t n) {\n  for (uint32_t i = 0; i < n; ++i) {\n    keep();\n  }\n}\n");
  const bool is_named = refusal.find("(program.cpp:2)") != std::string::npos ||
                        refusal.find("(program.cpp:3)") != std::string::npos;
  EXPECT_TRUE(is_named) << refusal;
}

TEST(Refusal, OuterLoopAroundOneWithAFact) {
  expect_refusal(
      "CASE void root(uint32_t n) {\n"
      "  for (uint32_t i = 0; i < n; ++i) for (const uint32_t j : bounded<7>(7, [] {})) { (void)j; keep(); "
      "}\n"
      "}",
      "a loop without a flow fact");
}

TEST(Refusal, InnerLoopWithinOneWithAFact) {
  expect_refusal(
      "CASE void root(uint32_t n) {\n"
      "  for (const uint32_t j : bounded<7>(7, [] {})) for (uint32_t i = j; i < n; ++i) keep();\n"
      "}",
      "a loop without a flow fact");
}

TEST(Refusal, LoopInACallee) {
  expect_refusal(
      "CASE void callee(uint32_t n) { for (uint32_t i = 0; i < n; ++i) keep(); }\n"
      "CASE void root(uint32_t n) { callee(n); keep(); }",
      "a loop without a flow fact", "callee at 0x");
}

TEST(Refusal, LoopBehindATable) {
  expect_refusal(
      "ASSEMBLER void root() { asm volatile(\"tbb [pc, r0]\\n3: .byte (1f - 3b) / 2, (2f - 3b) / 2\\n"
      "1: bx lr\\n2: subs r0, #1\\n\\tbne 2b\\n\\tbx lr\"); }",
      "a loop without a flow fact");
}

TEST(Refusal, LoopPastAPredicatedReturn) {
  expect_refusal(
      "ASSEMBLER void root() { asm volatile(\"push {r4, lr}\\n1: subs r0, #1\\n\\tit eq\\n\\tpopeq {r4, "
      "pc}\\n\\tb 1b\"); }",
      "a loop without a flow fact");
}

TEST(Refusal, TotalMadeInALoopWithoutFact) {
  expect_refusal(
      "CASE void root(uint32_t n) {\n"
      "  for (uint32_t i = 0; i < n; ++i) {\n"
      "    auto total = bounded_total<20>([] {});\n"
      "    for (const uint32_t j : total.take(0, n)) { (void)j; keep(); }\n"
      "  }\n}",
      "a loop without a flow fact");
}

TEST(Refusal, BodyWithoutItsEntry) {
  expect_refusal(
      "struct Place {};\n"
      "CASE void root(BoundedTotal<20, Place>& total) { for (const uint32_t i : total.take(0, 5)) { (void)i; "
      "keep(); } }",
      "a loop's body that is reached without its entry");
}

TEST(Refusal, Recursion) {
  expect_refusal(
      "CASE uint32_t root(uint32_t n) { if (n == 0) return 0; const uint32_t below = root(n - 1); keep(); "
      "return below + n; }",
      "recursion");
}

TEST(Refusal, RecursionByTailCalls) {
  expect_refusal(
      "CASE uint32_t odd(uint32_t n);\n"
      "CASE uint32_t root(uint32_t n) { return n == 0 ? 1 : odd(n - 1); }\n"
      "CASE uint32_t odd(uint32_t n) { return n == 0 ? 0 : root(n - 1); }",
      "recursion", "odd at 0x");
}

TEST(Refusal, IndirectCall) {
  expect_refusal("CASE void root(void (*f)()) { f(); keep(); }",
                 "an indirect call or jump without listed targets");
  expect_refusal("CASE void root(void (*f)()) { f(); }", "an indirect call or jump without listed targets");
}

TEST(Refusal, UndecodableCode) {
  expect_refusal("ASSEMBLER void root() { asm volatile(\".inst.w 0xffffffff\\n\\tbx lr\"); }",
                 "code that can't be decoded");
}

TEST(Refusal, JumpIntoData) {
  expect_refusal("ASSEMBLER void root() { asm volatile(\"b 1f\\n1: .word 0\"); }",
                 "jumps to where no instruction begins", "root at 0x");
}

TEST(Refusal, FunctionWithoutEnd) {
  expect_refusal(
      "ASSEMBLER void root() { asm volatile(\"nop\"); }\nASSEMBLER void z() { asm volatile(\"bx lr\"); }",
      "runs past its function's end");
}

TEST(Refusal, LibraryDivision) {
  expect_refusal(
      "ASSEMBLER void __aeabi_ldivmod() { asm volatile(\"bx lr\"); }\n"
      "CASE long long root(long long a, long long b) { return a / b; }",
      "calls __aeabi_ldivmod, library code without a bound");
}

TEST(Refusal, LibraryCopy) {
  expect_refusal(
      "ASSEMBLER void* memcpy(void*, const void*, unsigned) { asm volatile(\"bx lr\"); }\n"
      "CASE void root(uint32_t* to, const uint32_t* from, uint32_t n) { __builtin_memcpy(to, from, n); }",
      "calls memcpy, library code without a bound");
}

TEST(Refusal, FloatHelper) {
  expect_refusal(
      "ASSEMBLER void __aeabi_fmul() { asm volatile(\"bx lr\"); }\n"
      "CASE decltype(1.0f) root(decltype(1.0f) a) { return a * a; }",
      "calls __aeabi_fmul, library code without a bound");
}

TEST(Refusal, FloatingPointInstruction) {
  expect_refusal(
      "ASSEMBLER void root() { asm volatile(\".fpu fpv4-sp-d16\\n\\tvadd.f32 s0, s0, s1\\n\\tbx lr\"); }",
      "a floating-point instruction, vadd.f32 s0, s0, s1");
}

TEST(Refusal, Alloca) {
  expect_refusal(
      "CASE void use(void*) { keep(); }\n"
      "CASE void root(uint32_t n) { use(__builtin_alloca(n)); keep(); }",
      "sp changes by what is no constant");
}

TEST(Refusal, StackThatDiffersBetweenWays) {
  expect_refusal("ASSEMBLER void root() { asm volatile(\"cbz r0, 1f\\n\\tpush {r4}\\n1: nop\\n\\tbx lr\"); }",
                 "the stack's depth differs");
}

TEST(Refusal, FactWithTwoBounds) {
  const std::string refusal = refusal_of(
      "ASSEMBLER void root() { asm volatile(\n"
      "  \"1: nop\\n\\t.pushsection .wcet.flowfacts,\\\"?\\\",%progbits\\n\\t.word 1, 77, 1b, "
      "5\\n\\t.popsection\\n\"\n"
      "  \"2: nop\\n\\t.pushsection .wcet.flowfacts,\\\"?\\\",%progbits\\n\\t.word 2, 77, 2b, "
      "6\\n\\t.popsection\\n\"\n"
      "  \"bx lr\"); }");
  EXPECT_NE(refusal.find("has two bounds, 5 and 6"), std::string::npos) << refusal;
  EXPECT_EQ(refusal.find("root at 0x"), 0u) << refusal;
}

TEST(Refusal, FactWithoutItsNop) {
  const std::string refusal = refusal_of(
      "ASSEMBLER void root() { asm volatile(\n"
      "  \"1: mov r0, r1\\n\\t.pushsection .wcet.flowfacts,\\\"?\\\",%progbits\\n\\t.word 1, 77, 1b, "
      "5\\n\\t.popsection\\n\"\n"
      "  \"bx lr\"); }");
  EXPECT_NE(refusal.find("not at a nop"), std::string::npos) << refusal;
}

TEST(Refusal, UnalignedAccess) {
  expect_refusal("ASSEMBLER void root() { asm volatile(\"movw r3, #0x2001\\n\\tldr r0, [r3]\\n\\tbx lr\"); }",
                 "an unaligned access, ldr r0, [r3]");
  expect_refusal(
      "ASSEMBLER void root() { asm volatile(\"movs r3, #0\\n\\tmovt r3, #0x2000\\n\\tldrh r0, [r3, "
      "#3]\\n\\tbx "
      "lr\"); }",
      "an unaligned access, ldrh.w r0, [r3, #3]");
  expect_refusal("ASSEMBLER void root() { asm volatile(\"ldr.w r0, [sp, #2]\\n\\tbx lr\"); }",
                 "an unaligned access, ldr.w r0, [sp, #2]");
}

TEST(Refusal, UnalignedAccessesAllowedByTheCompiler) {
  const std::string source =
      "struct __attribute__((packed)) Odd { char before; uint32_t value; };\n"
      "CASE uint32_t root(const Odd& odd) { return odd.value; }";
  EXPECT_EQ(refusal_of(source), "");
  const std::string refusal = refusal_of(source, "-O2 -munaligned-access");
  EXPECT_NE(refusal.find("compiled with unaligned accesses allowed"), std::string::npos) << refusal;
}

TEST(Refusal, WaitingForAnInterrupt) {
  expect_refusal("ASSEMBLER void root() { asm volatile(\"wfi\\n\\tbx lr\"); }",
                 "waits for something outside");
}

}  // namespace
}  // namespace palpate::wcet::test
