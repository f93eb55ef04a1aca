#include "palpate/ports/cycle_counter.hpp"
#include "palpate/ports/tick_timer.hpp"
#include "registers.hpp"

namespace palpate::port {

using mps2::TickTimer;

void start_ticks(uint32_t period_us) {
  TickTimer::Reload::write(period_us * (mps2::kPeripheralClockHz / 1'000'000) - 1);
  TickTimer::Interrupt::write(1);
  mps2::NvicSetEnable::write(1u << mps2::kTickInterrupt);
  resume_ticks();
}

void hold_ticks() {
  TickTimer::Control::write(0);
  TickTimer::Interrupt::write(1);
  mps2::NvicClearPending::write(1u << mps2::kTickInterrupt);
  mps2::synchronize();
}

void resume_ticks() {
  TickTimer::Value::write(TickTimer::Reload::read());
  TickTimer::Control::write(TickTimer::kEnable | TickTimer::kInterruptEnable);
}

bool tick_pending() { return TickTimer::Interrupt::read() != 0; }

void wait_for_tick() {
  // Masked, an interrupt still ends the sleep but runs only afterwards; so no tick, and no hold by one, can
  // come between the question and the sleep.
  asm volatile("cpsid i" ::: "memory");
  if (TickTimer::Control::read() != 0) asm volatile("dsb\n\twfi" ::: "memory");
  asm volatile("cpsie i\n\tisb" ::: "memory");
}

// The emulated processor has no cycle counter. Timer 1 counts periods of 40 ns; under QEMU's -icount shift=0
// an instruction lasts 1 ns, so this unit is an instruction, known to 40.
uint32_t read_cycle_counter() {
  return (0u - mps2::FreeTimer::Value::read()) * (1'000'000'000 / mps2::kPeripheralClockHz);
}

uint32_t cycles_per_second() { return 1'000'000'000; }

}  // namespace palpate::port

/// Handler of timer 0.
extern "C" void palpate_tick_handler() {
  palpate::mps2::TickTimer::Interrupt::write(1);
  palpate::port::on_tick();
}
