// All that a tick can reach has a bound, in time and in stack, and the ports keep to their contracts:
// palpate_tick_bound_test <firmware ELF> <board>.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "wcet/bound.hpp"
#include "wcet/stack.hpp"
#include "wcet/worst_path.hpp"

namespace palpate::target {
namespace {

std::string g_firmware;
std::string g_board;

constexpr const char* kTick = "palpate::port::on_tick()";

const wcet::Program& firmware() {
  static const wcet::Program program(g_firmware);
  return program;
}

wcet::CallGraph calls_below(const std::string& root) {
  return wcet::CallGraph(firmware(), firmware().image().find_function(root).start);
}

/// Of the emulated boards, whose devices take no time, there is none.
const wcet::Devices& devices() {
  static const wcet::Devices of_board =
      g_board.rfind("mps2_", 0) == 0
          ? wcet::Devices{}
          : wcet::read_devices(PALPATE_SOURCE_FOLDER "/tests/wcet/devices/" + g_board + ".toml");
  return of_board;
}

TEST(Tick, IsBounded) {
  const wcet::CallGraph calls = calls_below(kTick);
  for (const char* model_name : {"instructions", "m4", "m7"}) {
    wcet::CostModel model = wcet::read_cost_model(model_name);
    const wcet::Cycles plain = wcet::BoundAnalysis(firmware(), calls, model).bound();
    model.devices = devices();
    const wcet::Cycles bound = wcet::BoundAnalysis(firmware(), calls, model).bound();
    std::printf("%s: %ld, %ld of it for device registers\n", model_name, bound, bound - plain);
    EXPECT_GT(plain, 1000);
    EXPECT_EQ(bound > plain, !devices().ranges.empty());
  }
  EXPECT_GT(calls.functions().size(), 20u);
  EXPECT_TRUE(calls.path_ends().empty()) << "no tick gives up";
}

TEST(Tick, HasRoomOnTheStack) {
  constexpr uint32_t kStackBytes = 4096;
  const uint32_t tick = wcet::measure_stack(firmware(), calls_below(kTick)).back().deepest_bytes;
  const wcet::InterruptedStack stack =
      wcet::measure_interrupted_stack(firmware(), "palpate_reset_handler", kTick);
  std::printf("%u bytes of stack: background %u, frame %u, tick %u\n", stack.bytes(), stack.background,
              stack.frame, stack.interrupt);
  EXPECT_EQ(stack.interrupt, tick);
  EXPECT_LE(stack.bytes(), kStackBytes);
}

// What docs/timing.md adds for a board, without its image: calls x accesses x cycles.
TEST(Ports, TakeNoMoreThanTheirContracts) {
  if (devices().ranges.empty()) GTEST_SKIP() << "an emulated board";
  const wcet::CallGraph calls = calls_below(kTick);
  wcet::CostModel model = wcet::read_cost_model("m7");
  const wcet::Cycles plain = wcet::BoundAnalysis(firmware(), calls, model).bound();
  model.devices = devices();
  const wcet::BoundAnalysis bounds(firmware(), calls, model);
  const wcet::WorstPath path = wcet::walk_worst_path(calls, bounds);
  double allowed = 0;
  for (size_t i = 0; i < path.functions.size(); ++i) {
    const std::string& name = calls.functions()[i].name;
    for (const wcet::PortContract& port : devices().contracts) {
      if (name.find(port.function + "(") == 0)
        allowed += path.functions[i].calls * port.accesses * static_cast<double>(port.cycles);
    }
  }
  std::printf("%ld cycles of device registers, %.0f by the contracts\n", bounds.bound() - plain, allowed);
  EXPECT_GT(bounds.bound(), plain);
  EXPECT_LE(static_cast<double>(bounds.bound() - plain), allowed);
}

/// Nothing takes time but device registers, each access one.
wcet::CostModel count_accesses() {
  wcet::CostModel model;
  model.devices = devices();
  for (wcet::DeviceRange& range : model.devices.ranges) range.cycles = 1;
  return model;
}

TEST(Ports, KeepToTheirContracts) {
  if (devices().ranges.empty()) GTEST_SKIP() << "an emulated board";
  const wcet::CostModel model = count_accesses();
  const wcet::CallGraph tick = calls_below(kTick);
  uint32_t ports = 0;
  for (const wcet::FunctionGraph& function : tick.functions()) {
    if (function.name.find("palpate::port::") != 0 || function.name == kTick) continue;
    const std::string name = function.name.substr(0, function.name.find('('));
    const auto contract =
        std::find_if(devices().contracts.begin(), devices().contracts.end(),
                     [&](const wcet::PortContract& known) { return known.function == name; });
    ASSERT_NE(contract, devices().contracts.end()) << name << " has no contract";
    const wcet::CallGraph calls(firmware(), function.entry);
    const wcet::Cycles accesses = wcet::BoundAnalysis(firmware(), calls, model).bound();
    std::printf("%s: at most %ld of %u accesses\n", name.c_str(), accesses, contract->accesses);
    EXPECT_LE(accesses, contract->accesses) << name;
    ++ports;
  }
  EXPECT_GE(ports, 12u);
}

}  // namespace
}  // namespace palpate::target

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (argc != 3) {
    std::fprintf(stderr, "usage: palpate_tick_bound_test <firmware ELF> <board>\n");
    return 2;
  }
  palpate::target::g_firmware = argv[1];
  palpate::target::g_board = argv[2];
  return RUN_ALL_TESTS();
}
