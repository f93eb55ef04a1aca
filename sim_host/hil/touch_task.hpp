// The scenario `touch`: what the hand does, and the device that it holds.
#pragma once

#include "plant/plant.hpp"
#include "scenario/scenario.hpp"

namespace palpate::sim {

/// From power on in the reset pose to the end. Throws BadInput where the arm does not reach.
plant::Plant touch_plant(const Scenario& scenario);
uint32_t touch_ticks(const Scenario& scenario);

}  // namespace palpate::sim
