// Names of functions as people read them.
#pragma once

#include <optional>
#include <string>

namespace palpate::wcet {

/// Without its type, arguments and parameters: "palpate::Forces::evaluate".
std::string shortened(const std::string& name);

/// A stage of the tick, by the namespace that all of them are in: "forces" of
/// ...tick_stages::forces<...>(...).
std::optional<std::string> stage_name(const std::string& function);

}  // namespace palpate::wcet
