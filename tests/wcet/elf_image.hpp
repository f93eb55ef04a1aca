// A linked 32-bit Arm executable: sections, functions, which bytes are code, and the records of its flow
// facts.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace palpate::wcet {

struct Section {
  std::string name;
  uint32_t address = 0;
  bool loaded = false;
  bool writable = false;
  bool executable = false;
  uint32_t size = 0;
  std::vector<uint8_t> bytes;  // empty for sections without contents

  [[nodiscard]] bool holds(uint32_t at) const { return at >= address && at - address < size; }
};

struct FunctionSymbol {
  uint32_t start = 0;
  uint32_t end = 0;
  std::string mangled;
  std::string name;  // demangled
};

struct Symbol {
  std::string name;
  uint32_t address = 0;
  bool is_undefined = false;
};

/// One record of the section .wcet.flowfacts, 16 bytes.
struct FlowRecord {
  uint32_t kind;
  uint32_t id;
  uint32_t pc;
  uint32_t bound;
};
static_assert(sizeof(FlowRecord) == 16);

class ElfImage {
 public:
  /// Throws BadInput when the path holds no 32-bit Arm executable with symbols.
  explicit ElfImage(const std::string& path);

  [[nodiscard]] const std::vector<Section>& sections() const { return sections_; }
  [[nodiscard]] const Section* find_section(const std::string& name) const;
  [[nodiscard]] const std::vector<Symbol>& symbols() const { return symbols_; }
  /// By address. Of several names of one address the first.
  [[nodiscard]] const std::map<uint32_t, FunctionSymbol>& functions() const { return functions_; }
  /// nullptr outside of all functions.
  [[nodiscard]] const FunctionSymbol* function_around(uint32_t address) const;
  /// The only function of that name: mangled, demangled, or a part of it. Throws BadInput.
  [[nodiscard]] const FunctionSymbol& find_function(const std::string& name) const;
  /// Thumb code, by the mapping symbols $t and $d: not a table or a literal among it.
  [[nodiscard]] bool is_code(uint32_t address) const;
  /// The first address behind the stretch of code, or of data, that holds the address.
  [[nodiscard]] uint32_t stretch_end(uint32_t address) const;
  /// Little endian; nothing where the file has no such bytes.
  [[nodiscard]] std::optional<uint32_t> read(uint32_t address, uint32_t bytes) const;
  [[nodiscard]] std::vector<FlowRecord> flow_records() const;

 private:
  friend class ElfReader;
  std::vector<Section> sections_;
  std::vector<Symbol> symbols_;
  std::map<uint32_t, FunctionSymbol> functions_;
  std::map<uint32_t, bool> stretches_;  // by first address; true: code
};

}  // namespace palpate::wcet
