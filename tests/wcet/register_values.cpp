#include "register_values.hpp"

#include <algorithm>

namespace palpate::wcet {

RegisterValues::RegisterValues() : values_{}, symbols_(0) {
  for (Value& value : values_) value = {++symbols_, 0};
}

std::optional<AddressRange> RegisterValues::range_of(const Instruction& instruction) const {
  const std::optional<MemoryAccess>& memory = instruction.memory;
  if (!memory || memory->has_index) return std::nullopt;
  const Value& base = values_[memory->base];
  return AddressRange{base.symbol, base.offset + memory->offset, memory->bytes};
}

bool RegisterValues::hold_constant_within(uint32_t first, uint32_t last) const {
  return std::any_of(values_.begin(), values_.end(), [&](const Value& value) {
    return value.symbol == 0 && first <= value.offset && value.offset <= last;
  });
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
