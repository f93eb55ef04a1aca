// Port: the bytes between a board whose device is simulated and the simulation, over whatever the board has:
// files of the debugger, a serial line. Only a firmware in lockstep uses it.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::port {

/// Called by: the background, once, before the others. Unbounded.
void open_lockstep_stream();

/// Waits for the next byte. When the other end is gone it ends the program.
///
/// Called by: the background. Unbounded: the simulation sets time.
uint8_t read_lockstep_stream();

/// Sends bytes, in order.
///
/// Called by: the background. Unbounded: it waits until they are accepted.
void write_lockstep_stream(const uint8_t* bytes, uint32_t count);

}  // namespace palpate::port
