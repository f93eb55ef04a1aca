// Stack, from the machine code: what every function takes, and the deepest chain of calls.
#pragma once

#include <vector>

#include "call_graph.hpp"

namespace palpate::wcet {

struct StackUse {
  uint32_t own_bytes = 0;
  uint32_t deepest_bytes = 0;          // with all callees
  std::optional<size_t> next_deepest;  // the callee on the deepest chain
};

/// In the call graph's order. Throws Refusal when sp changes by what is no constant, as alloca makes it, or
/// differs between ways to one place.
std::vector<StackUse> measure_stack(const Program& program, const CallGraph& calls);

/// The stack of a program whose interrupt comes on top of its background, wherever that is.
struct InterruptedStack {
  uint32_t background = 0;
  uint32_t frame = 0;  // what the processor keeps of the background (Armv7-M, B1.5.7)
  uint32_t interrupt = 0;

  [[nodiscard]] uint32_t bytes() const { return background + frame + interrupt; }
};

/// Throws Refusal, and BadInput where a function is not there.
InterruptedStack measure_interrupted_stack(const Program& program, const std::string& background,
                                           const std::string& interrupt);

}  // namespace palpate::wcet
