// Port: the watchdog that cuts the amplifiers when the cycle stops.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::port {

/// Toggles the watchdog's line once. The hardware cuts the amplifiers when it sees no edge for a few periods,
/// so a board never toggles it from anywhere else.
///
/// Called by: the cycle, once a tick, as its last act.
/// Bounded by: straight-line code, at most 1 device-register access. Never waits.
void toggle_amplifier_watchdog();

}  // namespace palpate::port
