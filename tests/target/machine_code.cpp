#include "machine_code.hpp"

#include <cxxabi.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <regex>
#include <stdexcept>

namespace palpate::target {
namespace {

std::string demangled(const std::string& name) {
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> text(
      abi::__cxa_demangle(name.c_str(), nullptr, nullptr, &status), std::free);
  return status == 0 ? text.get() : name;
}

bool begins(const std::string& text, const char* start) { return text.rfind(start, 0) == 0; }

// "r0, 1c48 <name+0xdc>" and "1c48 <name>": the number before the name.
uint32_t target_of(const std::string& operands) {
  const std::string numbers = operands.substr(0, operands.find(" <"));
  return static_cast<uint32_t>(std::stoul(numbers.substr(numbers.rfind(' ') + 1), nullptr, 16));
}

// What the instruction does when its condition, if any, holds.
Flow flow_of(const std::string& base, const std::string& operands) {
  if (base[0] == '.') return Flow::kData;
  if (base == "b" || base == "cbz" || base == "cbnz") return Flow::kJump;
  if (base == "bl") return Flow::kCall;
  if (base == "tbb" || base == "tbh") return Flow::kTable;
  if (base == "udf") return Flow::kEnd;
  if (base == "bx") return operands == "lr" ? Flow::kEnd : Flow::kIndirect;
  if (base == "blx") return Flow::kIndirect;
  // Only a return takes pc from the stack or from lr.
  if (operands.find("pc}") != std::string::npos && !begins(base, "st")) {
    return base == "pop" || begins(operands, "sp!") ? Flow::kEnd : Flow::kIndirect;
  }
  if (begins(operands, "pc,")) {
    return begins(operands, "pc, [sp]") || operands == "pc, lr" ? Flow::kEnd : Flow::kIndirect;
  }
  return Flow::kPlain;
}

struct Extent {
  uint32_t start;
  uint32_t end;
  std::string name;
};

std::map<uint32_t, Extent> extents(const ElfFile& elf) {
  std::map<uint32_t, Extent> all;
  for (const Symbol& symbol : elf.symbols()) {
    if (ELF32_ST_TYPE(symbol.entry.st_info) != STT_FUNC || symbol.entry.st_shndx == SHN_UNDEF) continue;
    const uint32_t start = symbol.entry.st_value & ~1u;  // bit 0 only says Thumb
    all.emplace(start, Extent{start, start + symbol.entry.st_size, demangled(symbol.name)});
  }
  // What is written in assembler may have no size: then it reaches to the next function.
  for (auto at = all.begin(); at != all.end(); ++at) {
    const auto next = std::next(at);
    const uint32_t limit = next == all.end() ? UINT32_MAX : next->first;
    if (at->second.end == at->second.start) at->second.end = limit;
  }
  return all;
}

}  // namespace

Instruction decode(uint32_t address, const std::string& mnemonic, const std::string& operands) {
  // The flow mnemonics come first, so that bls is b with a condition and not bl with a suffix.
  static const std::regex pattern(
      "(blx|bl|bx|b|cbn?z|tb[bh]|udf|\\..*|[a-z0-9]+?)"
      "(eq|ne|cs|cc|hs|lo|mi|pl|vs|vc|hi|ls|ge|lt|gt|le)?(\\.[nw])?");
  std::smatch parts;
  if (!std::regex_match(mnemonic, parts, pattern)) throw std::runtime_error("what is '" + mnemonic + "'?");
  const std::string base = parts[1];
  Instruction instruction;
  instruction.address = address;
  instruction.flow = flow_of(base, operands);
  const bool conditional = parts[2].matched || base == "cbz" || base == "cbnz";
  const bool leaves = instruction.flow == Flow::kJump || instruction.flow == Flow::kTable ||
                      instruction.flow == Flow::kEnd || instruction.flow == Flow::kData;
  instruction.goes_on = conditional || !leaves;
  if (instruction.flow == Flow::kJump || instruction.flow == Flow::kCall) {
    instruction.target = target_of(operands);
  }
  return instruction;
}

std::map<uint32_t, Function> read_functions(const std::string& path) {
  const std::map<uint32_t, Extent> known = extents(ElfFile(path));
  std::map<uint32_t, Function> functions;
  for (const auto& [address, extent] : known) functions[address] = {address, extent.name, {}};
  const std::string command = "arm-none-eabi-objdump -d --no-show-raw-insn '" + path + "'";
  FILE* listing = popen(command.c_str(), "r");
  if (listing == nullptr) throw std::runtime_error("can't run objdump");
  static const std::regex pattern("\\s*([0-9a-f]+):\t([^\t\n]+)(?:\t([^\t;\n]*))?[^]*");
  std::array<char, 4096> line{};
  std::cmatch parts;
  while (std::fgets(line.data(), line.size(), listing) != nullptr) {
    if (!std::regex_match(line.data(), parts, pattern)) continue;
    const auto address = static_cast<uint32_t>(std::stoul(parts[1], nullptr, 16));
    const auto after = known.upper_bound(address);
    if (after == known.begin() || address >= std::prev(after)->second.end) continue;
    std::string operands = parts[3];
    operands.erase(operands.find_last_not_of(' ') + 1);
    functions[std::prev(after)->first].code.push_back(decode(address, parts[2], operands));
  }
  if (pclose(listing) != 0) throw std::runtime_error("objdump failed on " + path);
  return functions;
}

}  // namespace palpate::target
