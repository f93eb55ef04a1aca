// The scenario's parameter `settings`: which settings change on the way, and when.
//
//   "3000: max force = 2.5; 4000: warm = 70"
//
// In tick 3000 the setting `max force` becomes 2.5 N, and so on. docs/container-format.md names the settings
// and their units.
#pragma once

#include "hil/closed_loop.hpp"
#include "scenario/scenario.hpp"

namespace palpate::sim {

/// Of a scenario that is complete. Throws BadInput where the text says something else, or the firmware would
/// refuse a change.
std::vector<PlannedChange> planned_changes(const Scenario& scenario);

}  // namespace palpate::sim
