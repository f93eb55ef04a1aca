// What registers hold, as "some unknown + a constant": enough to see that two accesses of a block are
// disjoint, and which of a function's have an address that is a constant.
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
  /// The same of an access that has an address, without its index.
  [[nodiscard]] AddressRange base_of(const Instruction& instruction) const;
  /// Whether the unknown is what a register held at first.
  static constexpr bool is_from_before(uint32_t symbol) { return symbol != 0 && symbol <= 16; }
  /// Only constants and what is from before; the rest are unknowns that nothing is known of.
  [[nodiscard]] RegisterValues known_part() const;
  /// The known part of both. False when that is what it was.
  bool join(const RegisterValues& other);
  /// After a call: what it need not keep (AAPCS32, 6.1.1) is unknown.
  void forget_scratch();
  /// Whether any register holds a known constant of the range.
  [[nodiscard]] bool hold_constant_within(uint32_t first, uint32_t last) const;
  void execute(const Instruction& instruction);

 private:
  struct Value {
    uint32_t symbol;
    int64_t offset;

    [[nodiscard]] bool is_known() const { return symbol <= 16; }
  };

  std::array<Value, 16> values_;
  uint32_t symbols_;
};

}  // namespace palpate::wcet
