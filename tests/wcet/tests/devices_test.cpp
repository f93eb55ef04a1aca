#include "../devices.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <numeric>
#include <regex>

#include "../bound.hpp"
#include "../refusal.hpp"
#include "cross_compiler.hpp"

namespace palpate::wcet::test {
namespace {

Cycles device_cycles_of(const std::string& code, const std::string& port = "root") {
  const TargetProgram target(std::string(kShorthands) + "ASSEMBLER void root() { asm volatile(\"" + code +
                             "\\n bx lr\"); }");
  const CallGraph calls(target.program(), target.entry_of("root"));
  const std::vector<Cycles> cycles =
      device_cycles({{{"timer", 0x40000000, 0x40000fff, 7}}, {port}, {}}, calls.functions().back());
  return std::accumulate(cycles.begin(), cycles.end(), Cycles{0});
}

TEST(Devices, AccessesByConstantAddress) {
  EXPECT_EQ(device_cycles_of("mov r3, #0x40000000\\n ldr r0, [r3, #4]\\n str r0, [r3, #8]"), 14);
  EXPECT_EQ(device_cycles_of("movw r3, #0x10\\n movt r3, #0x4000\\n ldr r0, [r3]"), 7);
  EXPECT_EQ(device_cycles_of(
                "ldr r3, 1f\\n ldr r0, [r3]\\n bx lr\\n .align 2\\n 1: .word 0x40000020\\n .thumb\\n nop"),
            7);
  EXPECT_EQ(device_cycles_of("mov r3, #0x20000000\\n ldr r0, [r3, #4]"), 0);
}

TEST(Devices, AccessesThatMayBeOne) {
  EXPECT_EQ(device_cycles_of("ldr r0, [r3, #4]"), 0) << "it names no register";
  EXPECT_EQ(device_cycles_of("mov r3, #0x40000000\\n ldr r1, [r3]\\n ldr r0, [r1]"), 14);
  EXPECT_EQ(device_cycles_of("mov r3, #0x40000000\\n ldr r0, [r3, r1]\\n push {r0}\\n pop {r0}"), 7);
}

TEST(Devices, KeepTheirAddressBetweenBlocks) {
  const std::string either = "mov r3, #0x40000000\\n cbz r0, 1f\\n %\\n 1: ldr r0, [r3]";
  const auto with = [&](const std::string& way) {
    return std::string(either).replace(either.find('%'), 1, way);
  };
  EXPECT_EQ(device_cycles_of(with("nop"), "no port"), 7);
  EXPECT_EQ(device_cycles_of(with("mov r3, #0x20000000"), "no port"), 0) << "two ways, two addresses";
  EXPECT_EQ(device_cycles_of(with("mov r3, #0x20000000")), 7) << "a port's may be one";
}

TEST(Devices, AreNotWhatAFunctionIsHanded) {
  EXPECT_EQ(device_cycles_of("mov r3, #0x40000000\\n ldr r2, [r3]\\n str r2, [r0]\\n str r2, [r0, #4]"), 7);
  EXPECT_EQ(device_cycles_of("mov r3, #0x40000000\\n ldr r0, [r3]\\n str r2, [r0]"), 14)
      << "it is another r0";
}

TEST(Devices, OnlyPortsMeanThemUnsaid) {
  const std::string code = "mov r3, #0x40000000\\n ldr r1, [r3]\\n ldr r0, [r1]";
  EXPECT_EQ(device_cycles_of(code), 14);
  EXPECT_EQ(device_cycles_of(code, "palpate::port::"), 7);
}

// Polls until a bit of the register is set, or for a bounded number of times.
std::string refusal_of_polling(const std::string& loop, uint32_t first = 0x40000000) {
  const TargetProgram target(
      std::string(kShorthands) + kBoundedLoops +
      "inline volatile uint32_t& status() { return *reinterpret_cast<volatile uint32_t*>"
      "(0x40000010); }\n"
      "CASE void root() { " +
      loop + " }");
  const CallGraph calls(target.program(), target.entry_of("root"));
  CostModel model = read_cost_model("m4");
  model.devices = {{{"timer", first, first + 0xfff, 7}}, {"root"}, {}};
  try {
    const BoundAnalysis bounds(target.program(), calls, model);
  } catch (const Refusal& refusal) {
    return refusal.what();
  }
  return "";
}

TEST(Devices, RefusesPolling) {
  const std::string until_ready = "while ((status() & 1) == 0) {}";
  const std::string some_times = "for (const uint32_t i : bounded<9>(9, [] {})) { if (status() > i) break; }";
  const std::string writes = "for (const uint32_t i : bounded<9>(9, [] {})) status() = i;";
  EXPECT_NE(refusal_of_polling(until_ready).find("root at 0x"), std::string::npos);
  EXPECT_NE(refusal_of_polling(until_ready).find("polls a device register, ldr"), std::string::npos);
  EXPECT_NE(refusal_of_polling(some_times).find("polls a device register, ldr"), std::string::npos);
  EXPECT_EQ(refusal_of_polling(some_times, 0x50000000), "") << "memory may be read in a loop";
  EXPECT_EQ(refusal_of_polling(writes), "");
  EXPECT_EQ(refusal_of_polling("if (status() > 3) status() = 0;"), "");
}

TEST(Devices, SaysWhatIsWrong) {
  const palpate::test::TemporaryFolder folder;
  const std::string path = folder / "devices.toml";
  const std::string ports = "ports = ['port']\n[[range]]\nname = 'timer'\n";
  const std::string range = "first = 5\nlast = 6\ncycles = 1\nsource = 'x'\n";
  for (const std::string& text :
       {std::string("no ranges"), std::string("ports = ['port']"),
        ports + "first = 5\nlast = 4\ncycles = 1\nsource = 'x'", ports + "first = 5\nlast = 6\ncycles = 1",
        ports + range + "[[port]]\nname = 'port::read'\naccesses = 1\nrange = 'clock'"}) {
    std::ofstream(path) << text;
    EXPECT_THROW(read_devices(path), BadInput) << text;
  }
  std::ofstream(path) << ports + range + "[[port]]\nname = 'port::read'\naccesses = 1\nrange = 'timer'";
  EXPECT_EQ(read_devices(path).contracts.front().cycles, 1);
  EXPECT_EQ(read_devices(PALPATE_SOURCE_FOLDER "/tests/wcet/devices/peripherals.toml").ranges.size(), 2u);
}

std::string text_of_file(const std::string& path) {
  std::ifstream file(path);
  return std::string(std::istreambuf_iterator<char>(file), {});
}

// "at most 6 device-register accesses" in the comment right before the declaration.
uint32_t accesses_in_header(const std::string& header, const std::string& function) {
  const std::string text = text_of_file(PALPATE_SOURCE_FOLDER "/hal/ports/" + header);
  const size_t declaration = text.find(" " + function + "(");
  const size_t comment = text.rfind("\n\n", declaration);
  const std::string contract = text.substr(comment, declaration - comment);
  std::smatch found;
  if (std::regex_search(contract, found, std::regex("at most ([0-9]+)\\s*(///)?\\s*device-register")))
    return static_cast<uint32_t>(std::stoul(found[1]));
  EXPECT_NE(contract.find("no device-register access"), std::string::npos) << header << ": " << function;
  return 0;
}

TEST(Devices, OfTheBoardsFollowThePortsHeaders) {
  const std::regex row("name = \"palpate::port::(\\w+)\"\naccesses = (\\d+)\nrange = .*\nsource = \"(.*)\"");
  for (const char* board : {"stm32f4", "stm32h743", "imxrt1062"}) {
    const std::string path = PALPATE_SOURCE_FOLDER "/tests/wcet/devices/" + std::string(board) + ".toml";
    EXPECT_EQ(read_devices(path).contracts.size(), 13u);
    const std::string text = text_of_file(path);
    size_t rows = 0;
    for (std::sregex_iterator at(text.begin(), text.end(), row); at != std::sregex_iterator(); ++at, ++rows)
      EXPECT_EQ(std::stoul((*at)[2]), accesses_in_header((*at)[3], (*at)[1])) << board << ": " << (*at)[1];
    EXPECT_EQ(rows, 13u) << board;
  }
}

}  // namespace
}  // namespace palpate::wcet::test
