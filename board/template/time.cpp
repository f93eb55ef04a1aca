#include "palpate/ports/cycle_counter.hpp"
#include "palpate/ports/tick_timer.hpp"

namespace palpate::port {

// to do: program a timer for this period, enable its interrupt (no other one), and let the handler clear the
// request first and then call on_tick.
void start_ticks(uint32_t period_us) { static_cast<void>(period_us); }

// to do: stop the timer, clear its request, clear the pending interrupt, then a data barrier.
void hold_ticks() {}

// to do: start the timer again with a whole period ahead.
void resume_ticks() {}

// to do: say whether the timer's request is set again.
bool tick_pending() { return false; }

// to do: derive it from a counter that never stops.
uint32_t tick_number() { return 0; }

// to do: sleep until the interrupt, unless ticks are held. Ask and sleep with interrupts masked, or a tick
// that comes between the two is slept through.
void wait_for_tick() {}

// to do: read the cycle counter (DWT CYCCNT on a Cortex-M).
uint32_t read_cycle_counter() { return 0; }

// to do: its frequency in Hz.
uint32_t cycles_per_second() { return 1; }

}  // namespace palpate::port
