// Cycles of the processor, from its own counter (DWT CYCCNT).
#include "core_clock.hpp"
#include "palpate/ports/cycle_counter.hpp"
#include "system_registers.hpp"

namespace palpate::port {

uint32_t read_cycle_counter() { return cortex_m::DwtCycleCount::read(); }

uint32_t cycles_per_second() { return cortex_m::g_core_hz; }

}  // namespace palpate::port
