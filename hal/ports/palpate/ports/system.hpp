// Port: the board's beginning and end.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::port {

/// The whole program. The firmware defines it; the board calls it once, when memory is initialized and before
/// anything else runs.
[[noreturn]] void run_firmware();

/// Brings clocks, memories, pins, console and converters into the state that the other ports count on: motors
/// at code 2048, amplifiers off, ticks not started, cycle counter running.
///
/// Called by: the background, once, before every other port. Unbounded.
void initialize_board();

/// Ends the program: 0 fine, 1 a check failed. A board with nowhere to go switches the amplifiers off and
/// sleeps.
///
/// Called by: the background and the board's fault handler. It does not return.
[[noreturn]] void exit_program(int status);

/// The most stack used since reset, in bytes; 0 where the board can't tell.
///
/// Called by: the background. Bounded by: one pass over the stack.
uint32_t stack_peak_bytes();

}  // namespace palpate::port
