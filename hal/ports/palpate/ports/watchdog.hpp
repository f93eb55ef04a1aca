// Port: the watchdogs, which take over when the cycle stops.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::port {

/// Toggles the line of the amplifiers' watchdog and restarts the processor's own. The amplifiers' hardware
/// cuts them when it sees no edge for a few periods; the processor's resets the board. So a board does
/// neither anywhere else.
///
/// Called by: the cycle, as its last act, and only when all of its stages ended before the next tick was due.
/// Bounded by: straight-line code, at most 2 device-register accesses. Never waits.
void feed_watchdogs();

/// Starts the processor's watchdog, where the board has one: 10 ms after the last feeding it resets.
///
/// Called by: the background, once, right before start_ticks. Bounded by: at most 6 device-register accesses.
void start_watchdog();

}  // namespace palpate::port
