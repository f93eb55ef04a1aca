#include "palpate/ports/cycle_counter.hpp"
#include "registers.hpp"

namespace palpate::port {

// The emulated processor has no cycle counter. Timer 1 counts periods of 40 ns; under QEMU's -icount shift=0
// an instruction lasts 1 ns, so this unit is an instruction, known to 40.
uint32_t read_cycle_counter() {
  return (0u - mps2::FreeTimer::Value::read()) * (1'000'000'000 / mps2::kPeripheralClockHz);
}

uint32_t cycles_per_second() { return 1'000'000'000; }

}  // namespace palpate::port
