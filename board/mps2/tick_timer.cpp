#include "palpate/ports/tick_timer.hpp"
#include "registers.hpp"
#include "tick_vector.hpp"

namespace palpate::port {

using mps2::TickTimer;

namespace {

uint32_t g_period = 1;  // in counts of the free timer, which has the tick timer's clock
uint32_t g_number = 0;
uint32_t g_number_time = 0;  // when that period began, nearly

uint32_t now() { return 0u - mps2::FreeTimer::Value::read(); }

}  // namespace

void start_ticks(uint32_t period_us) {
  g_period = period_us * (mps2::kPeripheralClockHz / 1'000'000);
  TickTimer::Reload::write(g_period - 1);
  TickTimer::Interrupt::write(1);
  cortex_m::NvicSetEnable::write(1u << cortex_m::kTickInterrupt);
  resume_ticks();
}

void hold_ticks() {
  TickTimer::Control::write(0);
  TickTimer::Interrupt::write(1);
  cortex_m::NvicClearPending::write(1u << cortex_m::kTickInterrupt);
  cortex_m::synchronize();
}

void resume_ticks() {
  g_number_time = now();
  TickTimer::Value::write(TickTimer::Reload::read());
  TickTimer::Control::write(TickTimer::kEnable | TickTimer::kInterruptEnable);
}

bool tick_pending() { return TickTimer::Interrupt::read() != 0; }

// Whole periods since the last question, to the nearest: a tick's own delay is far below half of one.
uint32_t tick_number() {
  const uint32_t periods = (now() - g_number_time + g_period / 2) / g_period;
  g_number += periods;
  g_number_time += periods * g_period;
  return g_number;
}

void wait_for_tick() {
  // Masked, an interrupt still ends the sleep but runs only afterwards; so no tick, and no hold by one, can
  // come between the question and the sleep.
  asm volatile("cpsid i" ::: "memory");
  if (TickTimer::Control::read() != 0) asm volatile("dsb\n\twfi" ::: "memory");
  asm volatile("cpsie i\n\tisb" ::: "memory");
}

}  // namespace palpate::port

/// Handler of timer 0.
extern "C" void palpate_tick_handler() {
  palpate::mps2::TickTimer::Interrupt::write(1);
  palpate::port::on_tick();
}
