// The control-flow graph of one function: everything that its entry reaches by jumps, wherever it lies.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "program.hpp"

namespace palpate::wcet {

inline constexpr size_t kReturns = SIZE_MAX;   // the edge leaves the function
inline constexpr size_t kEnds = SIZE_MAX - 1;  // nothing follows: a trap, or a callee that never returns

struct Edge {
  size_t to = kReturns;  // a block, kReturns or kEnds
  bool taken = false;    // by the jump at the block's end
  std::optional<uint32_t> callee;
};

struct Block {
  std::vector<const Instruction*> code;
  std::vector<Edge> edges;

  [[nodiscard]] uint32_t address() const { return code.front()->address; }
  [[nodiscard]] const Instruction& last() const { return *code.back(); }
};

struct FunctionGraph {
  uint32_t entry = 0;
  std::string name;
  std::vector<Block> blocks;  // the first is the entry
};

/// What is asked of a graph. For the stack, what waits goes on, and library code is code like any other.
enum class Purpose : uint8_t { kTime, kStack };

/// Throws Refusal where the flow can't be followed. `returns` says whether a callee ever comes back.
FunctionGraph build_graph(const Program& program, uint32_t entry, Purpose purpose,
                          const std::function<bool(uint32_t)>& returns);

/// The addresses that an instruction may continue at within its function, and those that it calls.
struct Successors {
  std::vector<uint32_t> taken;  // by its jump
  bool goes_on = false;         // to the next instruction
  std::vector<uint32_t> callees;
  bool returns = false;  // to the caller; with callees: a tail call
};

/// `entry`: of the function; a jump to another function's start is a tail call. Indirect targets are those of
/// `marked`. Throws Refusal.
Successors successors_of(const Program& program, uint32_t entry, const Instruction& at, Purpose purpose,
                         const std::vector<uint32_t>& marked);

}  // namespace palpate::wcet
