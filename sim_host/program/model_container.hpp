// A scenario's model as a container (docs/container-format.md), and what a reader says of one in words.
#pragma once

#include <string>

#include "palpate/container/finding.hpp"
#include "scenario/scenario.hpp"

namespace palpate::sim {

/// The bytes of the file. They have been read back with the scenario's profile and are the same model; throws
/// BadInput where the reader refuses it.
std::string model_container(const Scenario& scenario);

/// One line, such as "at byte 168 in chunk REGN: out of range: shear: expected 0 to 178956971, found -1".
std::string describe(const container::Finding& finding);

}  // namespace palpate::sim
