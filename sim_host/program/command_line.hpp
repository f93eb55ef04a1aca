// The command line. Flags are the keys of parameter_table.hpp with dashes.
#pragma once

namespace palpate::sim {

/// Reads the command line and runs the command. Returns the exit code 0 or 1; throws BadInput for a wrong
/// command line.
int run_command_line(int argc, const char* const* argv);

}  // namespace palpate::sim
