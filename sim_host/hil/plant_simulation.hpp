#pragma once

#include <functional>

#include "hil/closed_loop.hpp"
#include "simulation/simulation.hpp"

namespace palpate::sim {

/// For `hil touch` on this machine; `watch` sees every tick. Throws BadInput when the model does not fit the
/// profile, or the arm does not reach.
std::unique_ptr<Simulation> make_plant_simulation(const Scenario& scenario,
                                                  std::function<void(const ClosedLoop&)> watch);

}  // namespace palpate::sim
