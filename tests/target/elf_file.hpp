// A 32-bit little-endian ELF file, read as plain structures.
#pragma once

#include <elf.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace palpate::target {

struct Section {
  std::string name;
  Elf32_Shdr header{};
  std::vector<uint8_t> bytes;  // empty for sections without contents

  [[nodiscard]] bool loaded() const { return (header.sh_flags & SHF_ALLOC) != 0; }
  [[nodiscard]] bool writable() const { return (header.sh_flags & SHF_WRITE) != 0; }
  [[nodiscard]] bool executable() const { return (header.sh_flags & SHF_EXECINSTR) != 0; }
  [[nodiscard]] bool holds(uint32_t address) const {
    return address >= header.sh_addr && address - header.sh_addr < header.sh_size;
  }
};

struct Symbol {
  std::string name;
  Elf32_Sym entry{};
};

/// One record of a bounded loop, as core/numeric/bounded.hpp writes it.
struct FlowFactRecord {
  uint32_t kind;
  uint32_t id;
  uint32_t pc;
  uint32_t bound;
};
static_assert(sizeof(FlowFactRecord) == 16);

class ElfFile {
 public:
  /// Throws std::runtime_error when the path holds no 32-bit Arm executable.
  explicit ElfFile(const std::string& path);

  [[nodiscard]] const std::vector<Section>& sections() const { return sections_; }
  [[nodiscard]] const std::vector<Symbol>& symbols() const { return symbols_; }
  /// nullptr when there is none.
  [[nodiscard]] const Section* find(const std::string& name) const;
  [[nodiscard]] std::vector<FlowFactRecord> flow_facts() const;

 private:
  void read_sections();
  void read_symbols();
  template <class Type>
  [[nodiscard]] Type read(size_t offset) const;

  std::vector<uint8_t> file_;
  std::vector<Section> sections_;
  std::vector<Symbol> symbols_;
};

}  // namespace palpate::target
