// Where a board's memories are, and what of a program a tick can reach.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "wcet/program.hpp"

namespace palpate::target {

struct Memory {
  uint32_t start = 0;
  uint32_t bytes = 0;

  [[nodiscard]] bool holds(uint32_t address, uint32_t size) const {
    return address >= start && uint64_t{address} + size <= uint64_t{start} + bytes;
  }
};

struct Layout {
  Memory code;        // beside the core: what a tick runs
  Memory data;        // beside the core: stack, constants, variables
  Memory store;       // read once or seldom
  Memory dma;         // what DMA writes
  uint32_t may_fill;  // of the data memory, by stack and variables
};

/// Throws std::runtime_error when the board is not known.
Layout layout_of(const std::string& board);

std::vector<const wcet::Instruction*> code_of(const wcet::Program& program,
                                              const wcet::FunctionSymbol& function);

/// All functions that `root`, a demangled name, can reach by calls and jumps. A jump through a register goes
/// to no known place.
std::vector<const wcet::FunctionSymbol*> reached_from(const wcet::Program& program, const std::string& root);

}  // namespace palpate::target
