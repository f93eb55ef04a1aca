// A program that fails on purpose: PALPATE_FAULT says how. The board must say so and end with status 1.
#include "palpate/ports/system.hpp"
#include "palpate/ports/tick_timer.hpp"

namespace palpate::port {

void on_tick() {}

void run_firmware() {
  initialize_board();
#if PALPATE_FAULT == 1
  asm volatile("udf #0");
#elif PALPATE_FAULT == 2
  asm volatile("ldr r0, =0x30000000\n\tldr r0, [r0]\n\t.ltorg" : : : "r0");  // nothing answers there
#else
  asm volatile("1: push {r0-r7}\n\tb 1b");  // the stack overflows
#endif
  exit_program(0);
}

}  // namespace palpate::port
