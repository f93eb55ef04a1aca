// Port: the three motor channels and the amplifiers behind them.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::port {

/// Converter codes of the three motors, in the device's joint order: 0 .. 4095, where 2048 is no current.
///
/// Called by: the cycle, once a tick, after the codes are known; the board's fault handler writes 2048
/// itself. Bounded by: straight-line code, at most 4 device-register accesses (three codes and a common
/// latch). Never waits: a converter that is still busy keeps its old code until the next tick.
void write_motors(const std::array<uint16_t, 3>& codes);

/// Turns the power stages on or off. Off is safe at any time and needs no order with write_motors.
///
/// Called by: the cycle, once a tick, after write_motors; the background, with false, before it gives up.
/// Bounded by: straight-line code, at most 1 device-register access. Never waits.
void set_amplifiers(bool enabled);

}  // namespace palpate::port
