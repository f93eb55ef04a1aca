// All that a tick can reach has a bound, in time and in stack: palpate_tick_bound_test <firmware ELF>.
#include <gtest/gtest.h>

#include <cstdio>

#include "wcet/bound.hpp"
#include "wcet/stack.hpp"

namespace palpate::target {
namespace {

std::string g_firmware;

const wcet::Program& firmware() {
  static const wcet::Program program(g_firmware);
  return program;
}

wcet::CallGraph calls_below(const std::string& root) {
  return wcet::CallGraph(firmware(), firmware().image().find_function(root).start);
}

TEST(Tick, IsBounded) {
  const wcet::CallGraph calls = calls_below("palpate::port::on_tick()");
  for (const char* model : {"instructions", "m4", "m7"}) {
    const wcet::BoundAnalysis bounds(firmware(), calls, wcet::read_cost_model(model));
    std::printf("%s: %ld\n", model, bounds.bound());
    EXPECT_GT(bounds.bound(), 1000);
  }
  EXPECT_GT(calls.functions().size(), 20u);
  EXPECT_TRUE(calls.path_ends().empty()) << "no tick gives up";
}

TEST(Tick, HasRoomOnTheStack) {
  constexpr uint32_t kStackBytes = 4096;
  const uint32_t bytes =
      wcet::measure_stack(firmware(), calls_below("palpate::port::on_tick()")).back().deepest_bytes;
  std::printf("%u bytes of stack\n", bytes);
  EXPECT_LT(bytes, kStackBytes);
}

}  // namespace
}  // namespace palpate::target

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (argc != 2) {
    std::fprintf(stderr, "usage: palpate_tick_bound_test <firmware ELF>\n");
    return 2;
  }
  palpate::target::g_firmware = argv[1];
  return RUN_ALL_TESTS();
}
