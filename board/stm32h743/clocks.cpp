// 480 MHz from 8 MHz (RM0433, chapters 6 and 8); parts before revision V reach 400 MHz.
#include "chip.hpp"
#include "core_clock.hpp"
#include "setup.hpp"

namespace palpate::stm32 {
namespace {

constexpr uint32_t kInternalHz = 64'000'000;
// The NUCLEO's ST-LINK gives 8 MHz as a signal. Where a crystal of 8 MHz stands: 0.
constexpr uint32_t kSignalInsteadOfCrystal = 1u << 18;  // HSEBYP

using ClockControl = cortex_m::Register<0x5802'4400>;  // RCC_CR
using ClockConfiguration = cortex_m::Register<0x5802'4410>;
using Domain1 = cortex_m::Register<0x5802'4418>;
using Domain2 = cortex_m::Register<0x5802'441C>;
using Domain3 = cortex_m::Register<0x5802'4420>;
using MultiplierSource = cortex_m::Register<0x5802'4428>;  // RCC_PLLCKSELR
using MultiplierSettings = cortex_m::Register<0x5802'442C>;
using MultiplierFactors = cortex_m::Register<0x5802'4430>;  // RCC_PLL1DIVR
using Domain3Sources = cortex_m::Register<0x5802'4458>;     // RCC_D3CCIPR
using Ahb1Enable = cortex_m::Register<0x5802'44D8>;
using Ahb2Enable = cortex_m::Register<0x5802'44DC>;
using Ahb4Enable = cortex_m::Register<0x5802'44E0>;
using Apb1LowEnable = cortex_m::Register<0x5802'44E8>;
using Apb2Enable = cortex_m::Register<0x5802'44F0>;
using Apb4Enable = cortex_m::Register<0x5802'44F4>;
using PowerStatus = cortex_m::Register<0x5802'4804>;     // PWR_CSR1
using PowerSupply = cortex_m::Register<0x5802'480C>;     // PWR_CR3
using VoltageScale = cortex_m::Register<0x5802'4818>;    // PWR_D3CR
using Overdrive = cortex_m::Register<0x5800'042C>;       // SYSCFG_PWRCR
using FlashAccess = cortex_m::Register<0x5200'2000>;     // FLASH_ACR
using DeviceIdentity = cortex_m::Register<0x5C00'1000>;  // DBGMCU_IDC

bool is_revision_v() { return DeviceIdentity::read() >> 16 >= 0x2003; }

// The regulator at its highest scale: 400 MHz; with its overdrive 480 MHz.
[[nodiscard]] bool raise_voltage(bool with_overdrive) {
  constexpr uint32_t kSupplies = 7;
  constexpr uint32_t kRegulator = 1u << 1;  // LDOEN; the first write decides until power goes
  constexpr uint32_t kScaleReady = 1u << 13;
  constexpr uint32_t kScale1 = 3u << 14;
  PowerSupply::change(kSupplies, kRegulator);
  if (!cortex_m::wait_until<PowerStatus>(kScaleReady, kScaleReady)) return false;
  VoltageScale::write(kScale1);
  if (!cortex_m::wait_until<VoltageScale>(kScaleReady, kScaleReady)) return false;
  if (!with_overdrive) return true;
  Overdrive::set(1u << 0);  // ODEN
  return cortex_m::wait_until<VoltageScale>(kScaleReady, kScaleReady);
}

// DIVM1 brings the source to 2 MHz; times DIVN1, by DIVP1 = 2.
[[nodiscard]] bool start_multiplier(uint32_t core_hz, bool from_outside) {
  constexpr uint32_t kPllOn = 1u << 24;
  constexpr uint32_t kPllReady = 1u << 25;
  constexpr uint32_t kInputFrom2To4Mhz = 1u << 2;  // PLL1RGE = 01; PLL1VCOSEL = 0: 192 to 960 MHz
  constexpr uint32_t kOutputP = 1u << 16;          // DIVP1EN
  const uint32_t source = from_outside ? (4u << 4) | 2 : 32u << 4;  // DIVM1, PLLSRC
  const uint32_t times = core_hz / 1'000'000;
  MultiplierSource::write(source);
  MultiplierSettings::write(kOutputP | kInputFrom2To4Mhz);
  MultiplierFactors::write(((2u - 1) << 9) | (times - 1));
  ClockControl::set(kPllOn);
  return cortex_m::wait_until<ClockControl>(kPllReady, kPllReady);
}

[[nodiscard]] bool switch_to_multiplier() {
  // Four wait states and the longest programming delay: enough for 240 MHz on the bus (chapter 4).
  constexpr uint32_t kFlashAtFullSpeed = (2u << 4) | 4;
  constexpr uint32_t kHalf = 4;            // of the buses' dividers
  constexpr uint32_t kPll = 3;             // SW = 011
  constexpr uint32_t kPllInUse = 3u << 3;  // SWS
  FlashAccess::write(kFlashAtFullSpeed);
  Domain1::write((kHalf << 4) | 8);  // D1PPRE; HPRE = 1000: / 2
  Domain2::write((kHalf << 8) | (kHalf << 4));
  Domain3::write(kHalf << 4);
  ClockConfiguration::write(kPll);
  return cortex_m::wait_until<ClockConfiguration>(7u << 3, kPllInUse);
}

}  // namespace

void enable_units() {
  Ahb4Enable::set(0x1F);                                   // ports A to E
  Ahb2Enable::set(1u << 29);                               // SRAM1
  Ahb1Enable::set((1u << 5) | (1u << 0));                  // ADC1, DMA1
  Apb1LowEnable::set((3u << 17) | (1u << 2) | (1u << 1));  // USART2, USART3, TIM4, TIM3
  Apb2Enable::set((1u << 1) | (1u << 0));                  // TIM8, TIM1
  Apb4Enable::set(1u << 1);                                // SYSCFG
  static_cast<void>(Apb4Enable::read());  // a unit answers after a read of its enable register
  cortex_m::synchronize();
}

// At the internal 64 MHz nothing that needs a tick of 1 ms works; the board can still say so.
bool initialize_clocks() {
  constexpr uint32_t kOutsideOn = 1u << 16;  // HSEON
  constexpr uint32_t kOutsideReady = 1u << 17;
  constexpr uint32_t kConverterFromInternal = 2u << 16;  // ADCSEL = per_ck, which is the internal 64 MHz
  const bool is_fast = is_revision_v();
  const uint32_t core_hz = is_fast ? 480'000'000 : 400'000'000;
  cortex_m::g_core_hz = kInternalHz;
  g_console_clock_hz = kInternalHz;
  g_link_clock_hz = kInternalHz;
  Domain3Sources::change(3u << 16, kConverterFromInternal);
  if (!raise_voltage(is_fast)) return false;
  ClockControl::set(kSignalInsteadOfCrystal);
  ClockControl::set(kOutsideOn);
  const bool has_outside = cortex_m::wait_until<ClockControl>(kOutsideReady, kOutsideReady);
  if (!start_multiplier(core_hz, has_outside) || !switch_to_multiplier()) return false;
  cortex_m::g_core_hz = core_hz;
  g_console_clock_hz = core_hz / 4;  // both on APB1
  g_link_clock_hz = core_hz / 4;
  return has_outside;
}

}  // namespace palpate::stm32
