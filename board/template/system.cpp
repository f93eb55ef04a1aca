#include "palpate/ports/system.hpp"
#include "palpate/ports/console.hpp"
#include "palpate/ports/link.hpp"
#include "palpate/ports/model_memory.hpp"

namespace palpate::port {

// to do: a reset handler that fills .data and .bss and then calls run_firmware, and the vector table.

// to do: wait until the transmitter takes a character, then write it; turn "\n" into what the far end
// expects.
void write_console(char character) { static_cast<void>(character); }

// to do: take a byte from the receiver's buffer, if there is one.
bool receive_byte(uint8_t& byte) {
  byte = 0;
  return false;
}

// Only in lockstep.
bool link_carries_device() { return false; }

// to do: put the byte into the transmitter's buffer, if there is room.
bool send_byte(uint8_t byte) {
  static_cast<void>(byte);
  return false;
}

// to do: the flash pages that the linker script keeps for the model.
ModelMemory model_memory() { return {nullptr, 0}; }

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
