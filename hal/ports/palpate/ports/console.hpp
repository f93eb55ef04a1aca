// Port: text output for people and test benches.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::port {

/// Writes one character; lines end with '\n' alone. It may wait for the line, so a cycle never calls it.
///
/// Called by: the background and the board's fault handler. Unbounded: it waits until the character is
/// accepted.
void write_console(char character);

}  // namespace palpate::port
