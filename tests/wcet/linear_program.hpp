// The longest path of a network as a linear program, solved with GLPK in exact arithmetic.
#pragma once

#include <vector>

#include "flow_network.hpp"

namespace palpate::wcet {

struct Solution {
  bool is_bounded = false;          // not where a loop has no bound, or no way out
  std::vector<double> counts;       // by arc
  std::vector<double> potentials;   // by node: the dual value of its balance
  std::vector<double> multipliers;  // by fact
};

/// The arcs' counts with the greatest cost: one unit enters and leaves, nodes are in balance, facts hold.
Solution find_longest_path(const Network& network, const std::vector<LoopFact>& facts);

/// By arc, whether it is part of a flow that goes round without entering and that no fact bounds.
std::vector<bool> find_unbounded_arcs(const Network& network, const std::vector<LoopFact>& facts);

}  // namespace palpate::wcet
