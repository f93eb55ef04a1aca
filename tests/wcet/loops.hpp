// What the loops of a worst case cost, and how the bound depends on each loop's own.
#pragma once

#include <string>
#include <vector>

#include "worst_path.hpp"

namespace palpate::wcet {

struct LoopFigures {
  LoopFact fact;
  std::string place;   // where its range is made, from the name of its id; empty without one
  double entries = 0;  // on the worst path
  double bodies = 0;
  double per_round = 0;  // what the bound would grow by if the loop's bound were one larger
};

/// All loops and totals of functions that have a bound, with zeros for those that the worst path does not
/// have: with other bounds it may have them. `per_round` is exact as long as the worst path stays the same:
/// it comes from the dual values (a fact's multiplier x its entries x calls of its function).
std::vector<LoopFigures> measure_loops(const Program& program, const BoundAnalysis& analysis,
                                       const WorstPath& path);

}  // namespace palpate::wcet
