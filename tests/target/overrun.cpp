// Every cycle is forced to overrun its period: overruns are counted, and the background gets its turn all the
// same when the cycle holds the ticks.
#include "palpate/ports/console.hpp"
#include "palpate/ports/cycle_counter.hpp"
#include "palpate/ports/system.hpp"
#include "palpate/ports/tick_timer.hpp"

namespace palpate::port {
namespace {

constexpr uint32_t kPeriodUs = 1000;
constexpr uint32_t kTicksToHold = 10;
constexpr uint32_t kHolds = 3;

uint32_t g_ticks = 0;
uint32_t g_overruns = 0;
volatile bool g_held = false;

}  // namespace

void on_tick() {
  const uint32_t start = read_cycle_counter();
  const uint32_t two_and_a_half_periods = cycles_per_second() / 400;
  while (read_cycle_counter() - start < two_and_a_half_periods) {
  }
  ++g_ticks;
  if (tick_pending()) ++g_overruns;
  if (g_ticks % kTicksToHold == 0) {
    hold_ticks();
    g_held = true;
  }
}

void run_firmware() {
  initialize_board();
  start_ticks(kPeriodUs);
  for (uint32_t hold = 0; hold < kHolds; ++hold) {
    while (!g_held) wait_for_tick();
    wait_for_tick();  // returns at once, or the program hangs here
    if (g_ticks != (hold + 1) * kTicksToHold) exit_program(1);
    g_held = false;
    resume_ticks();
  }
  hold_ticks();
  for (const char character : {'e', 'n', 'd', '\n'}) write_console(character);
  exit_program(g_overruns == kHolds * kTicksToHold ? 0 : 1);
}

}  // namespace palpate::port
