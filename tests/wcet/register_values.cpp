#include "register_values.hpp"

#include <algorithm>

namespace palpate::wcet {

RegisterValues::RegisterValues() : values_{}, symbols_(0) {
  for (Value& value : values_) value = {++symbols_, 0};
}

std::optional<AddressRange> RegisterValues::range_of(const Instruction& instruction) const {
  if (!instruction.memory || instruction.memory->has_index) return std::nullopt;
  return base_of(instruction);
}

AddressRange RegisterValues::base_of(const Instruction& instruction) const {
  const MemoryAccess& memory = *instruction.memory;
  const Value& base = values_[memory.base];
  return {base.symbol, base.offset + memory.offset, memory.bytes};
}

bool RegisterValues::hold_constant_within(uint32_t first, uint32_t last) const {
  return std::any_of(values_.begin(), values_.end(), [&](const Value& value) {
    return value.symbol == 0 && first <= value.offset && value.offset <= last;
  });
}

RegisterValues RegisterValues::known_part() const {
  RegisterValues known = *this;
  for (Value& value : known.values_) {
    if (!value.is_known()) value = {++known.symbols_, 0};
  }
  return known;
}

bool RegisterValues::join(const RegisterValues& other) {
  bool changed = false;
  for (size_t i = 0; i < values_.size(); ++i) {
    const bool is_same =
        values_[i].symbol == other.values_[i].symbol && values_[i].offset == other.values_[i].offset;
    if (!values_[i].is_known() || is_same) continue;
    values_[i] = {++symbols_, 0};
    changed = true;
  }
  return changed;
}

void RegisterValues::forget_scratch() {
  for (const uint8_t i : {uint8_t{0}, uint8_t{1}, uint8_t{2}, uint8_t{3}, uint8_t{12}, kLr})
    values_[i] = {++symbols_, 0};
}

void RegisterValues::execute(const Instruction& instruction) {
  const std::array<Value, 16> before = values_;
  for (uint8_t i = 0; i < 16; ++i) {
    if (has(instruction.writes, i)) values_[i] = {++symbols_, 0};
  }
  // Within an IT block nobody knows whether it happens.
  if (instruction.is_conditional) return;
  for (const std::optional<Assignment>& assignment : {instruction.assignment, instruction.writeback}) {
    if (!assignment) continue;
    const Value& source = before[assignment->source];
    Value& destination = values_[assignment->destination];
    switch (assignment->kind) {
      case Assignment::Kind::kConstant:
        destination = {0, static_cast<uint32_t>(assignment->value)};
        break;
      case Assignment::Kind::kUpperHalf:
        if (source.symbol == 0)
          destination = {0, (source.offset & 0xffff) | (int64_t{assignment->value} << 16)};
        break;
      case Assignment::Kind::kSum:
        destination = {source.symbol, source.offset + assignment->value};
        break;
    }
  }
}

}  // namespace palpate::wcet
