// The host has no tick interrupt: waiting for a tick runs it. So a cycle takes no simulated time, never
// overruns, and the results are those of a board whose cycles end in time.
#include "palpate/ports/tick_timer.hpp"

namespace palpate::port {
namespace {

bool g_running = false;
uint32_t g_ticks = 0;

}  // namespace

void start_ticks(uint32_t) { g_running = true; }

void hold_ticks() { g_running = false; }

void resume_ticks() { g_running = true; }

bool tick_pending() { return false; }

void wait_for_tick() {
  if (!g_running) return;
  ++g_ticks;
  on_tick();
}

uint32_t tick_number() { return g_ticks; }

}  // namespace palpate::port
