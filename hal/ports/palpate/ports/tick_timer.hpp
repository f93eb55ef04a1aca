// Port: the interrupt that starts a cycle every period. The board owns the interrupt: its handler clears the
// request and calls on_tick. It is the only interrupt that runs while ticks run, so a cycle is never
// preempted.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::port {

/// One cycle. The firmware defines it, the board calls it, never twice at a time.
void on_tick();

/// Starts the ticks, the first one a period from now.
///
/// Called by: the background, once. Bounded by: at most 8 device-register accesses.
void start_ticks(uint32_t period_us);

/// Stops the ticks and withdraws one that is already due, so that the background gets the processor however
/// long cycles take. The cycle that calls it finishes normally.
///
/// Called by: the cycle or the background. Bounded by: at most 4 device-register accesses. Never waits.
void hold_ticks();

/// Goes on after hold_ticks, the next tick a period from now.
///
/// Called by: the background. Bounded by: at most 4 device-register accesses.
void resume_ticks();

/// Whether the next tick is due already: asked at a cycle's end, it says that the cycle overran its period.
///
/// Called by: the cycle, once a tick. Bounded by: at most 1 device-register access. Never waits.
bool tick_pending();

/// Number of the period that this tick belongs to, modulo 2^32, from any start. The board takes it from a
/// clock that runs on, so a period without a tick leaves a gap.
///
/// Called by: the cycle, once a tick. Bounded by: at most 1 device-register access. Never waits.
uint32_t tick_number();

/// Sleeps until a tick has run. It may return early, and returns at once while ticks are held. A board
/// without interrupts runs the tick in here.
///
/// Called by: the background only. Unbounded.
void wait_for_tick();

}  // namespace palpate::port
