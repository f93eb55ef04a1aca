// The functions of an Arm executable, as far as their flow of control needs them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "elf_file.hpp"

namespace palpate::target {

enum class Flow : uint8_t {
  kPlain,     // on to the next instruction
  kJump,      // to the target; when `goes_on`, or to the next instruction
  kCall,      // to the target and back
  kTable,     // to some later instruction of the function: the offsets in a table of tbb or tbh have no sign
  kEnd,       // returns or faults
  kIndirect,  // writes pc in a way whose target is unknown
  kData       // no instruction
};

struct Instruction {
  uint32_t address = 0;
  Flow flow = Flow::kPlain;
  bool goes_on = true;  // may be followed by the next instruction
  uint32_t target = 0;  // of a jump or a call
};

struct Function {
  uint32_t address = 0;
  std::string name;  // demangled
  std::vector<Instruction> code;
};

/// One instruction as objdump prints it. A predicated one ends in its condition, so an IT block needs no
/// memory.
Instruction decode(uint32_t address, const std::string& mnemonic, const std::string& operands);

/// All functions, by address. Throws std::runtime_error when objdump fails.
std::map<uint32_t, Function> read_functions(const std::string& path);

}  // namespace palpate::target
