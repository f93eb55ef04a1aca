// Port: the buttons on the stylus.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::port {

inline constexpr uint32_t kGraspButton = 1;  // bit 0

/// The buttons that are down, one bit each; bits without a button are 0. Bouncing contacts are the board's
/// matter: it debounces over ticks, without waiting in any.
///
/// Called by: the cycle, once a tick, after read_encoders.
/// Bounded by: straight-line code, at most 1 device-register access. Never waits.
uint32_t read_buttons();

}  // namespace palpate::port
