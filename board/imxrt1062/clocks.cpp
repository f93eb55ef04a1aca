// 600 MHz from the crystal of 24 MHz; the buses run at 150 MHz (IMXRT1060RM, chapters CCM and DCDC).
#include "core_clock.hpp"
#include "units.hpp"

namespace palpate::imxrt {
namespace {

constexpr uint32_t kCrystalHz = 24'000'000;
constexpr uint32_t kCoreHz = 600'000'000;

using ArmDivider = Register<0x400F'C010>;       // CCM_CACRR
using BusDividers = Register<0x400F'C014>;      // CCM_CBCDR
using BusSources = Register<0x400F'C018>;       // CCM_CBCMR
using UartClock = Register<0x400F'C024>;        // CCM_CSCDR1
using Busy = Register<0x400F'C048>;             // CCM_CDHIPR
using LowPower = Register<0x400F'C054>;         // CCM_CLPCR
using ArmMultiplier = Register<0x400D'8000>;    // CCM_ANALOG_PLL_ARM
using RegulatorStatus = Register<0x4008'0000>;  // DCDC_REG0
using RegulatorTarget = Register<0x4008'000C>;  // DCDC_REG3

// Nothing here needs to save current. Two bits a unit: on, also while the processor sleeps.
void enable_all_units() {
  Register<0x400F'C068>::write(0xFFFF'FFFF);  // CCM_CCGR0
  Register<0x400F'C06C>::write(0xFFFF'FFFF);
  Register<0x400F'C070>::write(0xFFFF'FFFF);
  Register<0x400F'C074>::write(0xFFFF'FFFF);
  Register<0x400F'C078>::write(0xFFFF'FFFF);
  Register<0x400F'C07C>::write(0xFFFF'FFFF);
  Register<0x400F'C080>::write(0xFFFF'FFFF);  // CCM_CCGR6
  // LPM = 00: SysTick counts while the processor waits for it.
  LowPower::clear(3);
}

// Above 528 MHz: 1.25 V, in steps of 25 mV from 0.8 V.
[[nodiscard]] bool raise_voltage() {
  constexpr uint32_t kStable = 1u << 31;  // STS_DC_OK
  RegulatorTarget::change(0x1F, (1250 - 800) / 25);
  return cortex_m::wait_until<RegulatorStatus>(kStable, kStable);
}

[[nodiscard]] bool run_from(uint32_t peripheral_clock_2) {
  constexpr uint32_t kUsed = 1u << 25;  // PERIPH_CLK_SEL
  constexpr uint32_t kSwitching = 1u << 5;
  BusDividers::change(kUsed, peripheral_clock_2 != 0 ? kUsed : 0);
  return cortex_m::wait_until<Busy>(kSwitching, 0);
}

[[nodiscard]] bool start_arm_multiplier() {
  constexpr uint32_t kPowerDown = 1u << 12;
  constexpr uint32_t kEnable = 1u << 13;
  constexpr uint32_t kLocked = 1u << 31;
  constexpr uint32_t kTimes50 = 100;  // DIV_SELECT: half of it
  ArmMultiplier::write(kPowerDown);
  ArmMultiplier::write(kEnable | kTimes50);
  return cortex_m::wait_until<ArmMultiplier>(kLocked, kLocked);
}

}  // namespace

bool initialize_clocks() {
  constexpr uint32_t kArmByTwo = 1;  // ARM_PODF
  constexpr uint32_t kArmSwitching = 1u << 16;
  constexpr uint32_t kBusSwitching = 1u << 1;
  constexpr uint32_t kUartFromCrystal = 1u << 6;  // UART_CLK_SEL, and by UART_CLK_PODF = 0
  cortex_m::g_core_hz = kCrystalHz;
  enable_all_units();
  UartClock::change(0x7F, kUartFromCrystal);
  BusSources::change(3u << 12, 1u << 12);  // PERIPH_CLK2_SEL = 01: the crystal
  BusDividers::change(7u << 27, 0);        // PERIPH_CLK2_PODF
  if (!run_from(1) || !raise_voltage() || !start_arm_multiplier()) return false;
  ArmDivider::write(kArmByTwo);
  if (!cortex_m::wait_until<Busy>(kArmSwitching, 0)) return false;
  BusDividers::change((7u << 10) | (3u << 8), 3u << 8);  // AHB_PODF: / 1, IPG_PODF: / 4
  if (!cortex_m::wait_until<Busy>(kBusSwitching, 0)) return false;
  BusSources::change(3u << 18, 3u << 18);  // PRE_PERIPH_CLK_SEL = 11: the multiplier
  if (!run_from(0)) return false;
  cortex_m::g_core_hz = kCoreHz;
  return true;
}

}  // namespace palpate::imxrt
