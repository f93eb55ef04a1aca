// What must hold for every firmware image: palpate_elf_test <ELF> <at least so many flow facts>.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <regex>
#include <set>

#include "elf_file.hpp"

namespace palpate::target {
namespace {

std::string g_path;
size_t g_expected_flow_facts = 0;

constexpr uint32_t kCodeStart = 0x0000'0000;
constexpr uint32_t kCodeBytes = 64 * 1024;
constexpr uint32_t kDataStart = 0x2000'0000;
constexpr uint32_t kDataBytes = 256 * 1024;

const ElfFile& elf() {
  static const ElfFile file(g_path);
  return file;
}

bool inside(const Section& section, uint32_t start, uint32_t bytes) {
  return section.header.sh_addr >= start && section.header.sh_addr + section.header.sh_size <= start + bytes;
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
  const Section* text = elf().find(".text");
  ASSERT_NE(text, nullptr);
  for (const FlowFactRecord& fact : elf().flow_facts()) {
    ASSERT_TRUE(text->holds(fact.pc)) << std::hex << fact.pc;
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

TEST(Image, IsPlacedInTheCoupledMemories) {
  const std::set<std::string> known{".text", ".scenario", ".stack", ".data", ".bss"};
  for (const Section& section : elf().sections()) {
    if (!section.loaded() || section.header.sh_size == 0) continue;
    std::printf("%-12s %7u bytes at %08x\n", section.name.c_str(), section.header.sh_size,
                section.header.sh_addr);
    EXPECT_EQ(known.count(section.name), 1u) << section.name;
    EXPECT_TRUE(!section.executable() || inside(section, kCodeStart, kCodeBytes)) << section.name;
    EXPECT_TRUE(!section.writable() || inside(section, kDataStart, kDataBytes)) << section.name;
  }
}

}  // namespace
}  // namespace palpate::target

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (argc != 3) {
    std::fprintf(stderr, "usage: palpate_elf_test <ELF> <at least so many flow facts>\n");
    return 2;
  }
  palpate::target::g_path = argv[1];
  palpate::target::g_expected_flow_facts = std::strtoul(argv[2], nullptr, 10);
  return RUN_ALL_TESTS();
}
