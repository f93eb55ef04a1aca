// What each part does in its own way when it starts.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::stm32 {

// Of the units' clocks, once they run.
inline uint32_t g_console_clock_hz = 0;
inline uint32_t g_link_clock_hz = 0;

/// Clocks of all units that are used.
void enable_units();
/// False when the processor does not run from its crystal.
[[nodiscard]] bool initialize_clocks();
/// All pins but the motors'.
void initialize_pins();
/// The motors' pins, when their signal is that of no current.
void connect_motors();
[[nodiscard]] bool start_gimbal_converter();
/// What differs between processors.
void initialize_core();

}  // namespace palpate::stm32
