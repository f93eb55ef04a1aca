// Whether a model fits a profile.
#pragma once

#include "scenario/scenario.hpp"

namespace palpate::sim {

/// What a profile's State takes with a scenario's model.
struct Fit {
  uint32_t tets, nodes;
  std::size_t state_bytes;        // of the core
  std::size_t cycle_state_bytes;  // with the device
};

/// Gives an automatic level its value, the deepest up to 6 that the profile holds and that is not above a
/// region's most_level; and then least_level and most_level theirs. Throws BadInput when the level does not
/// fit, or none does, or the mesh may go deeper than the profile.
Fit fit_to_profile(Scenario& scenario);

}  // namespace palpate::sim
