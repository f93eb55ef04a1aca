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

}  // namespace palpate::wcet
