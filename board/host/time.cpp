// The host has no tick interrupt: waiting for a tick runs it. So a cycle takes no simulated time, never
// overruns, and the results are those of a board whose cycles end in time.
#include <chrono>

#include "palpate/ports/cycle_counter.hpp"
#include "palpate/ports/tick_timer.hpp"

namespace palpate::port {
namespace {

bool g_running = false;

}  // namespace

void start_ticks(uint32_t) { g_running = true; }

void hold_ticks() { g_running = false; }

void resume_ticks() { g_running = true; }

bool tick_pending() { return false; }

void wait_for_tick() {
  if (g_running) on_tick();
}

uint32_t read_cycle_counter() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return static_cast<uint32_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(now).count());
}

uint32_t cycles_per_second() { return 1'000'000'000; }

}  // namespace palpate::port
