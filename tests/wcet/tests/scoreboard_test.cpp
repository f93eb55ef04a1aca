// Short sequences on the scoreboard, from a quiet pipeline.
#include "../scoreboard.hpp"
#include "../block_times.hpp"

#include <gtest/gtest.h>

#include "cross_compiler.hpp"

namespace palpate::wcet::test {
namespace {

Cycles cycles_of(const std::string& model_name, const std::string& code, const PipelineState& entry = {},
                 Frame frame = Frame::kShared) {
  const TargetProgram target("extern \"C\" __attribute__((naked)) void root() { asm volatile(\"" + code +
                             "\"); }");
  const CostModel model = read_cost_model(model_name);
  const FunctionSymbol& root = target.program().image().find_function("root");
  Scoreboard scoreboard(model, entry, frame);
  for (uint32_t at = root.start; at < root.end; at = target.program().at(at)->next()) {
    scoreboard.issue(*target.program().at(at));
  }
  return scoreboard.cycles();
}

TEST(M4, AddsUp) {
  EXPECT_EQ(cycles_of("m4", "adds r0, #1\\n smlal r0, r1, r2, r3\\n udiv r0, r1, r2"), 1 + 1 + 12);
  EXPECT_EQ(cycles_of("m4", "ldr r0, [r1]\\n ldm r2, {r3, r4, r5}\\n str r0, [r1]\\n push {r4, r5}"),
            2 + 4 + 1 + 3);
}

TEST(M4, PipelinesWhatIsRightBehindALoad) {
  EXPECT_EQ(cycles_of("m4", "ldr r0, [r1]\\n ldr r2, [r3, #4]\\n ldrh r4, [r3, #8]"), 2 + 1 + 1);
  EXPECT_EQ(cycles_of("m4", "ldr r0, [r1]\\n ldr r2, [r0]"), 2 + 1 + 2) << "its address was loaded";
  EXPECT_EQ(cycles_of("m4", "ldr r0, [r1]\\n nop\\n ldr r2, [r3]"), 2 + 1 + 2);
  EXPECT_EQ(cycles_of("m4", "ldr r0, [r1], #4\\n ldr r2, [r3]"), 2 + 2) << "the base moved along";
  EXPECT_EQ(cycles_of("m4", "ldr r0, [r1]\\n ldr r2, [r3, #4]!"), 2 + 2);
  EXPECT_EQ(cycles_of("m4", "ldrd r0, r2, [r1]\\n ldr r4, [r3]"), 3 + 2);
  EXPECT_EQ(cycles_of("m4", "str r0, [r1]\\n str r0, [r1, #4]\\n ldr r2, [r3]"), 1 + 1 + 2);
  EXPECT_EQ(cycles_of("m4", "str r0, [r1, r2]\\n ldr r0, [r1]\\n str r0, [r1, r2]"), 2 + 2 + 1);
}

TEST(M4, WaitsForAnAddress) {
  EXPECT_EQ(cycles_of("m4", "adds r1, #4\\n ldr r0, [r1]"), 1 + 1 + 2);
  EXPECT_EQ(cycles_of("m4", "adds r1, #4\\n adds r2, #4\\n ldr r0, [r1]"), 1 + 1 + 2);
  EXPECT_EQ(cycles_of("m4", "adds r1, #4\\n ldr r0, [r2]"), 1 + 2);
}

TEST(M7, WaitsForLoads) {
  EXPECT_EQ(cycles_of("m7", "ldr r0, [r1]\\n adds r0, #1"), 1 + 1 + 1);
  EXPECT_EQ(cycles_of("m7", "ldr r0, [r1]\\n adds r2, #1\\n adds r0, #1"), 3);
  EXPECT_EQ(cycles_of("m7", "ldr r0, [r1]\\n ldr r2, [r0]"), 1 + 2 + 1);
  EXPECT_EQ(cycles_of("m7", "ldrb r0, [r1]\\n ldr r2, [r0]"), 1 + 3 + 1);
}

TEST(M7, WaitsForMultiplications) {
  EXPECT_EQ(cycles_of("m7", "mul r0, r1, r2\\n adds r0, #1"), 1 + 1 + 1);
  EXPECT_EQ(cycles_of("m7", "smlal r0, r1, r2, r3\\n smlal r0, r1, r2, r3"), 1 + 1 + 1) << "the sum is read";
}

TEST(M7, NeedsShiftedOperandsEarly) {
  EXPECT_EQ(cycles_of("m7", "add r0, r1\\n add r2, r3, r0, lsl #2"), 1 + 1 + 1);
  EXPECT_EQ(cycles_of("m7", "add r0, r1\\n add r2, r0, r3, lsl #2"), 1 + 1);
}

TEST(M7, WaitsForStoresThatALoadMayMeet) {
  EXPECT_EQ(cycles_of("m7", "str r0, [r1]\\n ldr r2, [r1]"), 1 + 8 + 1);
  EXPECT_EQ(cycles_of("m7", "str r0, [r1]\\n ldr r2, [r3]"), 1 + 8 + 1);
  EXPECT_EQ(cycles_of("m7", "str r0, [r1]\\n ldr r2, [r1, #4]"), 1 + 1);
  EXPECT_EQ(cycles_of("m7", "strd r0, r2, [r1]\\n ldr r2, [r1, #4]"), 3 + 8 + 1);
  EXPECT_EQ(cycles_of("m7", "str r0, [r1], #4\\n nop\\n ldr r2, [r1, #-4]"), 1 + 8 + 1)
      << "the base moved along";
  EXPECT_EQ(cycles_of("m7", "push {r0}\\n nop\\n ldr r2, [sp, #4]"), 3 + 1 + 1);
  EXPECT_EQ(cycles_of("m7", "str r0, [r1]\\n mov r4, r1\\n nop\\n ldr r2, [r4, #8]"), 4);
  EXPECT_EQ(cycles_of("m7", "str r0, [r1]\\n ldr r1, [r1, #8]\\n nop\\n nop\\n ldr r2, [r1, #4]"), 1 + 8 + 1)
      << "the base is another";
}

TEST(M7, KeepsAPrivateFrameApart) {
  const auto in_private = [](const std::string& code) { return cycles_of("m7", code, {}, Frame::kPrivate); };
  EXPECT_EQ(cycles_of("m7", "str r0, [sp, #4]\\n ldr r2, [r1]"), 1 + 8 + 1);
  EXPECT_EQ(in_private("str r0, [sp, #4]\\n ldr r2, [r1]"), 1 + 1);
  EXPECT_EQ(in_private("str r0, [r1]\\n ldr r2, [sp, #4]"), 1 + 1);
  EXPECT_EQ(in_private("str r0, [sp, #4]\\n ldr r2, [sp, #4]"), 1 + 8 + 1);
  EXPECT_EQ(in_private("str r0, [sp, #4]\\n ldr r2, [sp, #8]"), 1 + 1);
  EXPECT_EQ(in_private("str r0, [r1]\\n ldr r2, [r3]"), 1 + 8 + 1);
}

/// The same code, but that one takes an address in its frame and lets another function have it.
TEST(BlockTimes, SeeWhetherAFrameIsPrivate) {
  const std::string body =
      "\"push {r4, lr}\\n sub sp, #8\\n\" ADDRESS \"\\n str r0, [sp, #4]\\n ldr r2, [r1]\\n add sp, #8\\n "
      "pop {r4, pc}\"";
  const auto cycles_with = [&](const std::string& address) {
    const TargetProgram target("#define ADDRESS \"" + address +
                               "\"\nextern \"C\" __attribute__((naked)) void root() { asm volatile(" + body +
                               "); }");
    const FunctionGraph graph =
        build_graph(target.program(), target.entry_of("root"), Purpose::kTime, [](uint32_t) { return true; });
    return time_blocks(read_cost_model("m7"), graph).front();
  };
  const Cycles private_frame = cycles_with("add r3, r1, #4");
  EXPECT_GT(cycles_with("add r3, sp, #4"), private_frame);
  EXPECT_EQ(cycles_with("mov r3, sp"), cycles_with("add r3, sp, #4"));
}

TEST(M7, BeginsWithWhatIsOnItsWay) {
  const PipelineState worst = PipelineState::worst(read_cost_model("m7"));
  EXPECT_EQ(cycles_of("m7", "adds r0, #1", worst), 2 + 1);
  EXPECT_EQ(cycles_of("m7", "ldr r0, [r1]", worst), 8 + 1);
  EXPECT_EQ(cycles_of("m7", "ldr r0, [r1]", worst.after(6)), 2 + 1);
  EXPECT_EQ(cycles_of("m7", "ldr r0, [r1]", worst.after(9)), 1);
}

TEST(Pipeline, LeavesWhatIsOnItsWay) {
  const CostModel m7 = read_cost_model("m7");
  const TargetProgram target(
      "extern \"C\" __attribute__((naked)) void root() { asm volatile(\"str r0, [r1]\\n ldr r2, [r1, #4]\"); "
      "}");
  Scoreboard scoreboard(m7, {});
  const uint32_t root = target.entry_of("root");
  scoreboard.issue(*target.program().at(root));
  scoreboard.issue(*target.program().at(root + 2));
  PipelineState state = scoreboard.state();
  EXPECT_EQ(state.store, 8 - 1);
  EXPECT_EQ(state.ready[2].address, 2);
  EXPECT_EQ(state.ready[3].address, 0);
  EXPECT_TRUE(state.join(PipelineState::worst(m7)));
  EXPECT_FALSE(state.join(PipelineState::worst(m7)));
}

}  // namespace
}  // namespace palpate::wcet::test
