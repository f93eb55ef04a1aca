// Timers as decoders and as pulse-width modulators (RM0090, chapters 17 and 18; RM0433, chapters 38 and 39:
// the same registers as far as they are used here).
#pragma once

#include "register.hpp"

namespace palpate::stm32 {

template <uint32_t Base>
struct Timer {
  using Control1 = cortex_m::Register<Base + 0x00>;       // CR1
  using SlaveMode = cortex_m::Register<Base + 0x08>;      // SMCR
  using Events = cortex_m::Register<Base + 0x14>;         // EGR
  using CaptureMode1 = cortex_m::Register<Base + 0x18>;   // CCMR1
  using CaptureMode2 = cortex_m::Register<Base + 0x1C>;   // CCMR2
  using CaptureEnable = cortex_m::Register<Base + 0x20>;  // CCER
  using Count = cortex_m::Register<Base + 0x24>;          // CNT
  using Prescaler = cortex_m::Register<Base + 0x28>;      // PSC
  using Reload = cortex_m::Register<Base + 0x2C>;         // ARR
  using Compare1 = cortex_m::Register<Base + 0x34>;       // CCR1
  using Compare2 = cortex_m::Register<Base + 0x38>;
  using Compare3 = cortex_m::Register<Base + 0x3C>;
  using Break = cortex_m::Register<Base + 0x44>;  // BDTR, of TIM1 and TIM8 only

  /// Counts all four edges of channels 1 and 2, from 0, modulo 2^16.
  static void make_decoder() {
    constexpr uint32_t kInputs = (1u << 8) | (1u << 0);  // CC2S, CC1S = 01: both channels are inputs
    // IC2F, IC1F = 0110: six equal samples at a quarter of the clock. That is 0.3 us at 84 MHz and 0.1 us at
    // 240 MHz; at 250 kcounts/s edges are 4 us apart.
    constexpr uint32_t kFilters = (6u << 12) | (6u << 4);
    constexpr uint32_t kBothChannels = 3;  // SMS = 011
    CaptureMode1::write(kFilters | kInputs);
    CaptureEnable::write(0);  // neither is inverted
    SlaveMode::write(kBothChannels);
    Reload::write(0xFFFF);
    Count::write(0);
    Control1::write(kCount);
  }

  /// Three channels of 4096 steps, which begin at `steps`. A new value holds from the next period on.
  static void make_modulator(uint32_t steps) {
    constexpr uint32_t kMode1WithPreload = (6u << 4) | (1u << 3);     // OCxM = 110, OCxPE
    constexpr uint32_t kOutputs = (1u << 8) | (1u << 4) | (1u << 0);  // CC3E, CC2E, CC1E
    constexpr uint32_t kMainOutput = 1u << 15;                        // MOE
    constexpr uint32_t kUpdate = 1u << 0;                             // UG
    constexpr uint32_t kReloadPreload = 1u << 7;                      // ARPE
    Prescaler::write(0);
    Reload::write(4095);
    Compare1::write(steps);
    Compare2::write(steps);
    Compare3::write(steps);
    CaptureMode1::write((kMode1WithPreload << 8) | kMode1WithPreload);
    CaptureMode2::write(kMode1WithPreload);
    CaptureEnable::write(kOutputs);
    Break::write(kMainOutput);
    Events::write(kUpdate);
    Control1::write(kReloadPreload | kCount);
  }

 private:
  static constexpr uint32_t kCount = 1u << 0;  // CEN
};

}  // namespace palpate::stm32
