// What a measurement of everything below a root has to watch.
#pragma once

#include "bound.hpp"
#include "plugin/plan.hpp"

namespace palpate::wcet {

/// A fact's number in the plan is its place among the program's.
Plan make_plan(const Program& program, const CallGraph& calls, const BoundAnalysis& bounds);

}  // namespace palpate::wcet
