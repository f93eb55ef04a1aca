// The tick from the processor's own timer: the same on every Cortex-M, and no device interrupt is needed.
#include "core_clock.hpp"
#include "palpate/ports/tick_timer.hpp"
#include "system_registers.hpp"

namespace palpate::port {
namespace {

// SYST_CSR (Armv7-M, B3.3.3): enable, exception at 0, the processor's clock.
constexpr uint32_t kRun = (1u << 2) | (1u << 1) | (1u << 0);
constexpr uint32_t kEnabled = 1u << 0;
constexpr uint32_t kClearPending = 1u << 25;  // ICSR.PENDSTCLR
constexpr uint32_t kPending = 1u << 26;       // ICSR.PENDSTSET

// Of the processor's cycle counter, which never stops.
uint32_t g_period_cycles = 1;
uint32_t g_number = 0;
uint32_t g_number_time = 0;  // when that period began, nearly

}  // namespace

// 24 bits: 27 ms at 600 MHz.
void start_ticks(uint32_t period_us) {
  g_period_cycles = cortex_m::g_core_hz / 1'000'000 * period_us;
  cortex_m::SysTickReload::write(g_period_cycles - 1);
  resume_ticks();
}

void hold_ticks() {
  cortex_m::SysTickControl::write(0);
  cortex_m::InterruptControl::write(kClearPending);
  cortex_m::synchronize();
}

void resume_ticks() {
  g_number_time = cortex_m::DwtCycleCount::read();
  cortex_m::SysTickValue::write(0);  // the next clock loads the whole period
  cortex_m::SysTickControl::write(kRun);
}

bool tick_pending() { return (cortex_m::InterruptControl::read() & kPending) != 0; }

// Whole periods since the last question, to the nearest: a tick's own delay is far below half of one.
uint32_t tick_number() {
  const uint32_t periods =
      (cortex_m::DwtCycleCount::read() - g_number_time + g_period_cycles / 2) / g_period_cycles;
  g_number += periods;
  g_number_time += periods * g_period_cycles;
  return g_number;
}

void wait_for_tick() {
  // Masked, an interrupt still ends the sleep but runs only afterwards; so no tick, and no hold by one, can
  // come between the question and the sleep.
  asm volatile("cpsid i" ::: "memory");
  if ((cortex_m::SysTickControl::read() & kEnabled) != 0) asm volatile("dsb\n\twfi" ::: "memory");
  asm volatile("cpsie i\n\tisb" ::: "memory");
}

}  // namespace palpate::port

/// Handler of the SysTick exception; entering it has cleared the request.
extern "C" void palpate_tick_handler() { palpate::port::on_tick(); }
