// Why the program ends without a result, beside BadInput of model_parameters.hpp.
#pragma once

#include <stdexcept>

namespace palpate::sim {

/// The environment refuses: a folder, a disk, a missing program. Exit code 3. The message is one line.
struct EnvironmentError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The user stopped the run (Ctrl-C). What it had written is removed.
struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted; nothing was kept") {}
};

}  // namespace palpate::sim
