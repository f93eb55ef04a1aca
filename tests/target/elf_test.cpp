// What must hold for every firmware image: palpate_elf_test <ELF> <at least so many flow facts> <board>.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <regex>
#include <set>

#include "placement.hpp"

namespace palpate::target {
namespace {

std::string g_path;
size_t g_expected_flow_facts = 0;

Layout g_layout;

const wcet::Program& program() {
  static const wcet::Program read(g_path);
  return read;
}

const wcet::ElfImage& elf() { return program().image(); }

bool is_in(const wcet::Section& section, const Memory& memory) {
  return memory.holds(section.address, section.size);
}

std::string symbols_matching(const std::string& pattern) {
  const std::regex regex(pattern);
  std::string found;
  for (const wcet::Symbol& symbol : elf().symbols()) {
    if (std::regex_search(symbol.name, regex)) found += symbol.name + " ";
  }
  return found;
}

TEST(FlowFacts, AreNotLoaded) {
  const wcet::Section* section = elf().find_section(".wcet.flowfacts");
  if (g_expected_flow_facts == 0) GTEST_SKIP() << "none is expected";
  ASSERT_NE(section, nullptr);
  EXPECT_FALSE(section->loaded);
  EXPECT_EQ(section->bytes.size() % sizeof(wcet::FlowRecord), 0u);
}

TEST(FlowFacts, AreComplete) {
  constexpr uint32_t kEnter = 1;
  constexpr uint32_t kBody = 2;
  const std::vector<wcet::FlowRecord> facts = elf().flow_records();
  EXPECT_GE(facts.size(), g_expected_flow_facts);
  std::map<uint32_t, uint32_t> bounds;
  std::set<uint32_t> entered;
  std::set<uint32_t> bodies;
  for (const wcet::FlowRecord& fact : facts) {
    EXPECT_TRUE(fact.kind == kEnter || fact.kind == kBody) << "kind " << fact.kind;
    (fact.kind == kEnter ? entered : bodies).insert(fact.id);
    const auto known = bounds.emplace(fact.id, fact.bound).first;
    EXPECT_EQ(known->second, fact.bound) << "loop " << std::hex << fact.id << " has two bounds";
  }
  for (const uint32_t id : bodies) EXPECT_EQ(entered.count(id), 1u) << "loop " << std::hex << id;
}

TEST(FlowFacts, PointAtNops) {
  for (const wcet::FlowRecord& fact : elf().flow_records()) {
    const auto text =
        std::find_if(elf().sections().begin(), elf().sections().end(), [&](const wcet::Section& section) {
          return section.executable && section.loaded && section.holds(fact.pc);
        });
    ASSERT_NE(text, elf().sections().end()) << std::hex << fact.pc;
    const uint32_t at = fact.pc - text->address;
    const uint32_t instruction = text->bytes.at(at) | uint32_t{text->bytes.at(at + 1)} << 8;
    EXPECT_EQ(instruction, 0xbf00u) << "no nop at " << std::hex << fact.pc;
  }
}

TEST(Image, HasNoFloatingPointHelper) {
  EXPECT_EQ(symbols_matching("^__aeabi_(f|d|cf|cd|h2f|u?[il]2[fd])"), "");
  EXPECT_EQ(symbols_matching("^__(add|sub|mul|div|neg|cmp|eq|ne|lt|le|gt|ge|unord|pow)[sd]f[2-3]$"), "");
  EXPECT_EQ(symbols_matching("^__(float|fix|extend|trunc)[a-z]+$"), "");
}

TEST(Image, HasNoFloatingPointInstruction) {
  for (const auto& [address, instruction] : program().code()) {
    EXPECT_NE(instruction.flow, wcet::Flow::kFloat) << std::hex << address << ": " << instruction.text;
  }
  EXPECT_GT(program().code().size(), 100u);
}

TEST(Image, HasNoLibraryDivision) {
  EXPECT_EQ(symbols_matching("^__(aeabi_u?[il]div(mod)?|u?(div|mod)[a-z]*4?)$"), "");
}

TEST(Image, HasNoHeap) {
  EXPECT_EQ(symbols_matching("^(malloc|calloc|realloc|free|_?_?sbrk.*|_Z(nw|na|dl|da).*)$"), "");
}

TEST(Image, HasNoExceptionsVirtualsOrTypeNames) {
  EXPECT_EQ(symbols_matching("^(__cxa_|__gxx_|_Unwind_|_ZT[VISC])"), "");
  for (const wcet::Section& section : elf().sections()) {
    EXPECT_EQ(section.name.find(".ARM.ex"), std::string::npos) << section.name;
    EXPECT_EQ(section.name.find(".eh_frame"), std::string::npos) << section.name;
  }
}

// Criteria with a conforming front are for workstations (Profile::kStudyCriteria). A loop leaves its name
// even when it is inlined.
TEST(Image, HasNoCodeOfWhatItsProfileLacks) {
  EXPECT_EQ(symbols_matching("ConformingChanges"), "");
  if (g_expected_flow_facts == 0) return;
  EXPECT_NE(symbols_matching("RotationChanges.*begin_joins"), "") << "what the profile has is named so";
}

TEST(Image, RunsNoConstructor) {
  for (const wcet::Section& section : elf().sections()) {
    const bool constructors =
        std::regex_search(section.name, std::regex("init_array|fini_array|ctors|dtors"));
    EXPECT_FALSE(constructors && section.size > 0) << section.name;
  }
}

TEST(Image, HasNoUndefinedSymbol) {
  for (const wcet::Symbol& symbol : elf().symbols()) {
    EXPECT_FALSE(symbol.is_undefined && !symbol.name.empty()) << symbol.name;
  }
}

// Start-up and the background may run from where they are stored.
TEST(Image, IsPlacedInTheCoupledMemories) {
  const std::set<std::string> known{".text", ".scenario",        ".stack", ".data",
                                    ".bss",  ".text.background", ".boot",  ".dma"};
  const std::set<std::string> stored{".scenario", ".text.background", ".boot"};
  uint32_t data_bytes = 0;
  for (const wcet::Section& section : elf().sections()) {
    if (!section.loaded || section.size == 0) continue;
    std::printf("%-12s %7u bytes at %08x\n", section.name.c_str(), section.size, section.address);
    EXPECT_EQ(known.count(section.name), 1u) << section.name;
    const bool is_stored = stored.count(section.name) == 1 && is_in(section, g_layout.store);
    EXPECT_TRUE(!section.executable || is_stored || is_in(section, g_layout.code)) << section.name;
    const bool is_for_dma = section.name == ".dma" && is_in(section, g_layout.dma);
    EXPECT_TRUE(!section.writable || is_for_dma || is_in(section, g_layout.data)) << section.name;
    if (is_in(section, g_layout.data)) data_bytes += section.size;
  }
  EXPECT_LE(data_bytes, g_layout.may_fill);
}

TEST(Image, RunsTicksFromTheCoupledMemory) {
  constexpr uint32_t kMostTickCode = 64 * 1024;
  const std::vector<const wcet::FunctionSymbol*> reached =
      reached_from(program(), "palpate::port::on_tick()");
  ASSERT_GT(reached.size(), 1u);
  uint32_t bytes = 0;
  for (const wcet::FunctionSymbol* function : reached) {
    bytes += function->end - function->start;
    EXPECT_TRUE(g_layout.code.holds(function->start, function->end - function->start))
        << function->name << " at 0x" << std::hex << function->start;
    for (const wcet::Instruction* instruction : code_of(program(), *function)) {
      const bool is_indirect =
          instruction->flow == wcet::Flow::kIndirectJump || instruction->flow == wcet::Flow::kIndirectCall;
      EXPECT_FALSE(is_indirect) << function->name << ": " << instruction->text;
    }
  }
  std::printf("%zu functions of a tick, %u bytes\n", reached.size(), bytes);
  EXPECT_LE(bytes, kMostTickCode);
}

}  // namespace
}  // namespace palpate::target

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (argc != 4) {
    std::fprintf(stderr, "usage: palpate_elf_test <ELF> <at least so many flow facts> <board>\n");
    return 2;
  }
  palpate::target::g_path = argv[1];
  palpate::target::g_expected_flow_facts = std::strtoul(argv[2], nullptr, 10);
  palpate::target::g_layout = palpate::target::layout_of(argv[3]);
  return RUN_ALL_TESTS();
}
