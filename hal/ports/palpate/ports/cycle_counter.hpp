// Port: a clock for measurements. What it reads goes into reports and never into a result.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::port {

/// A free-running count of processor cycles, modulo 2^32. Where the processor has none, the finest clock of
/// the board in the unit that cycles_per_second states.
///
/// Called by: the cycle, twice a stage. Bounded by: straight-line code, at most 1 device-register access.
uint32_t read_cycle_counter();

/// How much read_cycle_counter advances in a second.
///
/// Called by: the background. Bounded by: no device-register access.
uint32_t cycles_per_second();

}  // namespace palpate::port
