// What registers hold within a block, as "some unknown + a constant": enough to see that two accesses are
// disjoint.
#pragma once

#include <array>
#include <optional>

#include "instruction.hpp"

namespace palpate::wcet {

struct AddressRange {
  uint32_t symbol;  // an unknown; 0: none, so that the offset is the address
  int64_t offset;
  uint32_t bytes;
};

constexpr bool may_overlap(const AddressRange& a, const AddressRange& b) {
  if (a.symbol != b.symbol) return true;
  return a.offset < b.offset + b.bytes && b.offset < a.offset + a.bytes;
}

class RegisterValues {
 public:
  RegisterValues();
  /// Of the instruction's access, before the instruction changes a register; nothing with an index.
  [[nodiscard]] std::optional<AddressRange> range_of(const Instruction& instruction) const;
  /// Whether any register holds a known constant of the range.
  [[nodiscard]] bool hold_constant_within(uint32_t first, uint32_t last) const;
  void execute(const Instruction& instruction);

 private:
  struct Value {
    uint32_t symbol;
    int64_t offset;
  };

  std::array<Value, 16> values_;
  uint32_t symbols_;
};

}  // namespace palpate::wcet
