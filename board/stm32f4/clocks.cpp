// 168 MHz from a crystal of 8 MHz, or from the internal oscillator when there is none (RM0090, chapter 7).
#include "chip.hpp"
#include "core_clock.hpp"
#include "setup.hpp"

namespace palpate::stm32 {
namespace {

constexpr uint32_t kCrystalHz = 8'000'000;
constexpr uint32_t kInternalHz = 16'000'000;
constexpr uint32_t kCoreHz = 168'000'000;

using ClockControl = cortex_m::Register<0x4002'3800>;        // RCC_CR, 7.3.1
using Multiplier = cortex_m::Register<0x4002'3804>;          // RCC_PLLCFGR, 7.3.2
using ClockConfiguration = cortex_m::Register<0x4002'3808>;  // RCC_CFGR, 7.3.3
using Ahb1Enable = cortex_m::Register<0x4002'3830>;          // 7.3.10
using Apb1Enable = cortex_m::Register<0x4002'3840>;          // 7.3.13
using Apb2Enable = cortex_m::Register<0x4002'3844>;          // 7.3.14
using FlashAccess = cortex_m::Register<0x4002'3C00>;         // FLASH_ACR, 3.9.1

[[nodiscard]] bool start_multiplier(uint32_t source_hz, bool from_crystal) {
  // PLLM brings the source to 1 MHz; times PLLN = 336, by PLLP = 2 (code 0). PLLQ = 7 is not used.
  constexpr uint32_t kPllOn = 1u << 24;
  constexpr uint32_t kPllReady = 1u << 25;
  constexpr uint32_t kQ = 7u << 24;
  constexpr uint32_t kN = 336u << 6;
  const uint32_t crystal = from_crystal ? 1u << 22 : 0;  // PLLSRC
  ClockControl::clear(kPllOn);
  Multiplier::write(kQ | crystal | kN | source_hz / 1'000'000);
  ClockControl::set(kPllOn);
  return cortex_m::wait_until<ClockControl>(kPllReady, kPllReady);
}

[[nodiscard]] bool switch_to_multiplier() {
  // Five wait states, prefetch and both caches (3.5.1): only start-up runs from flash.
  constexpr uint32_t kFlashAtFullSpeed = (1u << 10) | (1u << 9) | (1u << 8) | 5;
  constexpr uint32_t kBusDividers = (4u << 13) | (5u << 10);  // PPRE2: / 2, PPRE1: / 4
  constexpr uint32_t kPll = 2;                                // SW = 10
  constexpr uint32_t kPllInUse = 2u << 2;                     // SWS
  FlashAccess::write(kFlashAtFullSpeed);
  ClockConfiguration::write(kBusDividers);
  ClockConfiguration::write(kBusDividers | kPll);
  return cortex_m::wait_until<ClockConfiguration>(3u << 2, kPllInUse);
}

}  // namespace

void enable_units() {
  // Ports A to C, DMA1; TIM3 to TIM5, USART2, USART3; TIM8, ADC1, SYSCFG.
  Ahb1Enable::set((1u << 21) | (7u << 0));
  Apb1Enable::set((1u << 18) | (1u << 17) | (1u << 3) | (1u << 2) | (1u << 1));
  Apb2Enable::set((1u << 14) | (1u << 8) | (1u << 1));
  cortex_m::synchronize();  // a unit answers two clocks after this (RCC, errata ES0182)
}

// At the internal 16 MHz nothing that needs a tick of 1 ms works; the board can still say so.
bool initialize_clocks() {
  constexpr uint32_t kCrystalOn = 1u << 16;
  constexpr uint32_t kCrystalReady = 1u << 17;
  cortex_m::g_core_hz = kInternalHz;
  g_console_clock_hz = kInternalHz;
  g_link_clock_hz = kInternalHz;
  ClockControl::set(kCrystalOn);
  const bool has_crystal = cortex_m::wait_until<ClockControl>(kCrystalReady, kCrystalReady);
  const uint32_t source_hz = has_crystal ? kCrystalHz : kInternalHz;
  if (!start_multiplier(source_hz, has_crystal) || !switch_to_multiplier()) return false;
  cortex_m::g_core_hz = kCoreHz;
  g_console_clock_hz = kCoreHz / 4;  // both on APB1
  g_link_clock_hz = kCoreHz / 4;
  return has_crystal;
}

}  // namespace palpate::stm32
