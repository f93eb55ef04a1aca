// A board has nowhere to go: it takes the current away, says how the program ended, and sleeps. A watchdog
// that was started resets the board 10 ms after the last feeding.
#include "palpate/ports/console.hpp"
#include "palpate/ports/motors.hpp"
#include "palpate/ports/system.hpp"

namespace palpate::port {

[[noreturn]] void exit_program(int status) {
  asm volatile("cpsid i" ::: "memory");
  write_motors({2048, 2048, 2048});
  set_amplifiers(false);
  for (const char character : {'e', 'x', 'i', 't', ','}) write_console(character);
  write_console(status == 0 ? '0' : '1');
  write_console('\n');
  for (;;) asm volatile("wfi" ::: "memory");
}

}  // namespace palpate::port
