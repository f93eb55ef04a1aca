#include "palpate/ports/system.hpp"
#include "palpate/ports/console.hpp"

namespace palpate::port {

// to do: a reset handler that fills .data and .bss and then calls run_firmware, and the vector table.

// to do: wait until the transmitter takes a character, then write it; turn "\n" into what the far end
// expects.
void write_console(char character) { static_cast<void>(character); }

// to do: clocks, memory protection, pins, converters (code 2048), amplifiers off, console, cycle counter. On
// a Cortex-M7 also set ACTLR.DISBTACREAD, so that the timing bound's model of branches holds.
void initialize_board() {}

// to do: amplifiers off, report the status if anybody listens, then sleep for good.
[[noreturn]] void exit_program(int status) {
  static_cast<void>(status);
  for (;;) {
  }
}

// to do: fill the stack with a pattern at reset, and count here how much of it is gone.
uint32_t stack_peak_bytes() { return 0; }

}  // namespace palpate::port
