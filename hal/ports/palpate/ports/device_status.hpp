// Port: what the device's electronics report beside counts and buttons.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::port {

inline constexpr uint32_t kEmergencyStop = 1u << 0;   // the stop is pressed, or its wire is broken
inline constexpr uint32_t kAmplifierFault = 1u << 1;  // a power stage reports a fault
inline constexpr uint32_t kAmplifiersCut = 1u << 2;   // the amplifiers' watchdog has cut them

/// The reports that hold now. An input that nothing is wired to reads as its fault, so that a forgotten plug
/// is found before a motor moves; a board without that circuit leaves its bit 0 and says so in its page.
///
/// Called by: the cycle, once a tick, after read_encoders.
/// Bounded by: straight-line code, at most 3 device-register accesses. Never waits.
uint32_t read_device_status();

/// Whether the processor's own watchdog has reset the board since this was last asked.
///
/// Called by: the background, once, before ticks start.
bool was_reset_by_watchdog();

}  // namespace palpate::port
