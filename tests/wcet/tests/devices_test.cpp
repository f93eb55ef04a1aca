#include "../devices.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <numeric>

#include "../call_graph.hpp"
#include "../refusal.hpp"
#include "cross_compiler.hpp"

namespace palpate::wcet::test {
namespace {

Cycles device_cycles_of(const std::string& code, const std::string& port = "root") {
  const TargetProgram target(std::string(kShorthands) + "ASSEMBLER void root() { asm volatile(\"" + code +
                             "\\n bx lr\"); }");
  const CallGraph calls(target.program(), target.entry_of("root"));
  const std::vector<Cycles> cycles =
      device_cycles({{{"timer", 0x40000000, 0x40000fff, 7}}, {port}}, calls.functions().back());
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
  EXPECT_EQ(device_cycles_of("mov r3, #0x40000000\\n cbz r0, 1f\\n nop\\n 1: ldr r0, [r3]"), 7);
  EXPECT_EQ(device_cycles_of("mov r3, #0x40000000\\n ldr r0, [r3, r1]\\n push {r0}\\n pop {r0}"), 7);
}

TEST(Devices, OnlyPortsMeanThemUnsaid) {
  const std::string code = "mov r3, #0x40000000\\n ldr r0, [r3]\\n cbz r0, 1f\\n nop\\n 1: ldr r0, [r3]";
  EXPECT_EQ(device_cycles_of(code), 14);
  EXPECT_EQ(device_cycles_of(code, "palpate::port::"), 7);
}

TEST(Devices, SaysWhatIsWrong) {
  const palpate::test::TemporaryFolder folder;
  const std::string path = folder / "devices.toml";
  for (const char* text :
       {"no ranges", "ports = ['port']",
        "ports = ['port']\n[[range]]\nname = 'timer'\nfirst = 5\nlast = 4\ncycles = 1\nsource = 'x'",
        "ports = ['port']\n[[range]]\nname = 'timer'\nfirst = 5\nlast = 6\ncycles = 1"}) {
    std::ofstream(path) << text;
    EXPECT_THROW(read_devices(path), BadInput) << text;
  }
  EXPECT_EQ(read_devices(PALPATE_SOURCE_FOLDER "/tests/wcet/devices/peripherals.toml").ranges.size(), 2u);
}

}  // namespace
}  // namespace palpate::wcet::test
