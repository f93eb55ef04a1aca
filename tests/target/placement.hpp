// Where a board's memories are, and what of a program a tick can reach.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "machine_code.hpp"

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

/// All functions that `root`, a demangled name, can reach by calls and jumps; empty when there is no such
/// function. A jump through a register goes to no known place.
std::vector<const Function*> reached_from(const std::map<uint32_t, Function>& functions,
                                          const std::string& root);

}  // namespace palpate::target
