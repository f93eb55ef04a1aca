// The cycles of every block of a function, whatever way led to it.
#pragma once

#include <vector>

#include "control_flow.hpp"
#include "cost_model.hpp"

namespace palpate::wcet {

/// A block begins with what covers the states that its predecessors leave. Mispredictions are part of the
/// edges' costs and let latencies pass: where one does not happen, the time that it would have taken covers
/// what is left to wait.
std::vector<Cycles> time_blocks(const CostModel& model, const FunctionGraph& graph);

}  // namespace palpate::wcet
