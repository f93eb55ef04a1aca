// What must hold for every firmware image: palpate_elf_test <ELF> <at least so many flow facts> <board>.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <regex>
#include <set>

#include "elf_file.hpp"
#include "placement.hpp"

namespace palpate::target {
namespace {

std::string g_path;
size_t g_expected_flow_facts = 0;

Layout g_layout;

const ElfFile& elf() {
  static const ElfFile file(g_path);
  return file;
}

bool is_in(const Section& section, const Memory& memory) {
  return memory.holds(section.header.sh_addr, section.header.sh_size);
}

std::string symbols_matching(const std::string& pattern) {
  const std::regex regex(pattern);
  std::string found;
  for (const Symbol& symbol : elf().symbols()) {
    if (std::regex_search(symbol.name, regex)) found += symbol.name + " ";
  }
  return found;
}

TEST(FlowFacts, AreNotLoaded) {
  const Section* section = elf().find(".wcet.flowfacts");
  if (g_expected_flow_facts == 0) GTEST_SKIP() << "none is expected";
  ASSERT_NE(section, nullptr);
  EXPECT_FALSE(section->loaded());
  EXPECT_EQ(section->bytes.size() % sizeof(FlowFactRecord), 0u);
}

TEST(FlowFacts, AreComplete) {
  constexpr uint32_t kEnter = 1;
  constexpr uint32_t kBody = 2;
  const std::vector<FlowFactRecord> facts = elf().flow_facts();
  EXPECT_GE(facts.size(), g_expected_flow_facts);
  std::map<uint32_t, uint32_t> bounds;
  std::set<uint32_t> entered;
  std::set<uint32_t> bodies;
  for (const FlowFactRecord& fact : facts) {
    EXPECT_TRUE(fact.kind == kEnter || fact.kind == kBody) << "kind " << fact.kind;
    (fact.kind == kEnter ? entered : bodies).insert(fact.id);
    const auto known = bounds.emplace(fact.id, fact.bound).first;
    EXPECT_EQ(known->second, fact.bound) << "loop " << std::hex << fact.id << " has two bounds";
  }
  for (const uint32_t id : bodies) EXPECT_EQ(entered.count(id), 1u) << "loop " << std::hex << id;
}

TEST(FlowFacts, PointAtNops) {
  for (const FlowFactRecord& fact : elf().flow_facts()) {
    const auto text =
        std::find_if(elf().sections().begin(), elf().sections().end(), [&](const Section& section) {
          return section.executable() && section.loaded() && section.holds(fact.pc);
        });
    ASSERT_NE(text, elf().sections().end()) << std::hex << fact.pc;
    const uint32_t at = fact.pc - text->header.sh_addr;
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
  const std::string command = "arm-none-eabi-objdump -d --no-show-raw-insn '" + g_path + "'";
  const std::unique_ptr<FILE, int (*)(FILE*)> listing(popen(command.c_str(), "r"), pclose);
  ASSERT_NE(listing, nullptr);
  size_t instructions = 0;
  std::array<char, 4096> line{};
  // "    1a2b:\tvldr\ts0, [r0]": every floating-point mnemonic starts with v, and no other one does.
  while (std::fgets(line.data(), line.size(), listing.get()) != nullptr) {
    const char* mnemonic = std::strstr(line.data(), ":\t");
    if (mnemonic == nullptr) continue;
    ++instructions;
    EXPECT_NE(mnemonic[2], 'v') << line.data();
  }
  EXPECT_GT(instructions, 100u);
}

TEST(Image, HasNoLibraryDivision) {
  EXPECT_EQ(symbols_matching("^__(aeabi_u?[il]div(mod)?|u?(div|mod)[a-z]*4?)$"), "");
}

TEST(Image, HasNoHeap) {
  EXPECT_EQ(symbols_matching("^(malloc|calloc|realloc|free|_?_?sbrk.*|_Z(nw|na|dl|da).*)$"), "");
}

TEST(Image, HasNoExceptionsVirtualsOrTypeNames) {
  EXPECT_EQ(symbols_matching("^(__cxa_|__gxx_|_Unwind_|_ZT[VISC])"), "");
  for (const Section& section : elf().sections()) {
    EXPECT_EQ(section.name.find(".ARM.ex"), std::string::npos) << section.name;
    EXPECT_EQ(section.name.find(".eh_frame"), std::string::npos) << section.name;
  }
}

TEST(Image, RunsNoConstructor) {
  for (const Section& section : elf().sections()) {
    const bool constructors =
        std::regex_search(section.name, std::regex("init_array|fini_array|ctors|dtors"));
    EXPECT_FALSE(constructors && section.header.sh_size > 0) << section.name;
  }
}

TEST(Image, HasNoUndefinedSymbol) {
  for (const Symbol& symbol : elf().symbols()) {
    EXPECT_FALSE(symbol.entry.st_shndx == SHN_UNDEF && !symbol.name.empty()) << symbol.name;
  }
}

// Start-up and the background may run from where they are stored.
TEST(Image, IsPlacedInTheCoupledMemories) {
  const std::set<std::string> known{".text", ".scenario",        ".stack", ".data",
                                    ".bss",  ".text.background", ".boot",  ".dma"};
  const std::set<std::string> stored{".scenario", ".text.background", ".boot"};
  uint32_t data_bytes = 0;
  for (const Section& section : elf().sections()) {
    if (!section.loaded() || section.header.sh_size == 0) continue;
    std::printf("%-12s %7u bytes at %08x\n", section.name.c_str(), section.header.sh_size,
                section.header.sh_addr);
    EXPECT_EQ(known.count(section.name), 1u) << section.name;
    const bool is_stored = stored.count(section.name) == 1 && is_in(section, g_layout.store);
    EXPECT_TRUE(!section.executable() || is_stored || is_in(section, g_layout.code)) << section.name;
    const bool is_for_dma = section.name == ".dma" && is_in(section, g_layout.dma);
    EXPECT_TRUE(!section.writable() || is_for_dma || is_in(section, g_layout.data)) << section.name;
    if (is_in(section, g_layout.data)) data_bytes += section.header.sh_size;
  }
  EXPECT_LE(data_bytes, g_layout.may_fill);
}

TEST(Image, RunsTicksFromTheCoupledMemory) {
  constexpr uint32_t kLongestInstruction = 4;
  constexpr uint32_t kMostTickCode = 64 * 1024;
  const std::map<uint32_t, Function> functions = read_functions(g_path);
  const std::vector<const Function*> reached = reached_from(functions, "palpate::port::on_tick()");
  ASSERT_GT(reached.size(), 1u);
  uint32_t bytes = 0;
  for (const Function* function : reached) {
    ASSERT_FALSE(function->code.empty()) << function->name;
    const uint32_t size = function->code.back().address + kLongestInstruction - function->address;
    bytes += size;
    EXPECT_TRUE(g_layout.code.holds(function->address, size))
        << function->name << " at 0x" << std::hex << function->address;
    for (const Instruction& instruction : function->code) {
      EXPECT_NE(instruction.flow, Flow::kIndirect) << function->name;
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
