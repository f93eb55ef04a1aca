// A scenario as C++ source for the firmware: the model and the script as integers, initialised without code.
#pragma once

#include <string>

#include "scenario/scenario.hpp"

namespace palpate::sim {

std::string firmware_image_source(const Scenario& scenario);

}  // namespace palpate::sim
