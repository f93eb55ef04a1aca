// What Capstone's instructions cost and do, as far as their names say it.
#pragma once

#include <string_view>

#include "instruction.hpp"

namespace palpate::wcet {

/// Of an instruction by its number in Capstone, multiplies aside.
struct InstructionKind {
  CostClass cost;
  uint32_t bytes;  // of one register in memory; 0: no access
  bool is_store;
};
InstructionKind kind_of(unsigned id);

/// mul, mla, mls, smull, smlal, smmul, smlad, usad8 and their kind.
bool is_multiply(std::string_view name);
/// Their first two operands are one sum that they add to; Capstone 4 says that they only write it.
bool adds_to_pair(std::string_view name);
/// Shifts, bit fields, extensions and saturations go through the shifter.
bool uses_shifter(unsigned id);

}  // namespace palpate::wcet
