// What the worst path is made of: how often every function and block runs on it, and what that costs.
#pragma once

#include <vector>

#include "bound.hpp"

namespace palpate::wcet {

struct FunctionFigures {
  double calls = 0;  // on the worst path; a solution need not be whole
  double own = 0;    // cycles in its own blocks
  double with_callees = 0;
};

struct BlockFigures {
  size_t function = 0;
  size_t block = 0;
  double count = 0;
  double own = 0;
};

struct WorstPath {
  std::vector<FunctionFigures> functions;  // in the call graph's order
  std::vector<BlockFigures> blocks;        // those that run, the costliest first
};

WorstPath walk_worst_path(const CallGraph& calls, const BoundAnalysis& analysis);

}  // namespace palpate::wcet
