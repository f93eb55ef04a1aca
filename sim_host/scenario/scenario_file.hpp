// Scenarios from TOML files: `scenario = "grasp"` names the built-in one to start from, other keys are those
// of parameter_table.hpp, and [[region]] tables give each material region its values (others are the top
// level's).
#pragma once

#include "scenario/scenario.hpp"

namespace palpate::sim {

/// Throws BadInput with file, line and column.
Scenario read_scenario_file(const std::string& path);

}  // namespace palpate::sim
