// Proof of a bound that needs no trust in the solver. Give every node a potential and every fact a multiplier
// >= 0. When on every arc
//
//   potential(from) - potential(to) + sum of multiplier x (bodies - bound x entries of from) >= cost,
//
// with potential 0 at the exit, then adding this up along any path that keeps the facts gives: its cost is at
// most the entry's potential (weak duality). The check is in rational numbers.
#pragma once

#include <optional>

#include "linear_program.hpp"

namespace palpate::wcet {

/// The bound that the solution's dual values prove, rounded down since costs are whole; nothing when they
/// prove none.
std::optional<Cycles> prove_bound(const Network& network, const std::vector<LoopFact>& facts,
                                  const Solution& solution);

}  // namespace palpate::wcet
