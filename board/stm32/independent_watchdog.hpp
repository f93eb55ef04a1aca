// The processor's independent watchdog, on a clock of its own (RM0090, chapter 21; RM0433, chapter 45).
#pragma once

#include "register.hpp"

namespace palpate::stm32 {

/// `OscillatorControl`: where its clock is switched on, RCC_CSR.
template <uint32_t Base, uint32_t OscillatorControl>
struct IndependentWatchdog {
  using Key = cortex_m::Register<Base + 0x0>;        // IWDG_KR
  using Prescaler = cortex_m::Register<Base + 0x4>;  // IWDG_PR
  using Reload = cortex_m::Register<Base + 0x8>;     // IWDG_RLR
  using Status = cortex_m::Register<Base + 0xC>;     // IWDG_SR: values on their way to the other clock

  static constexpr uint32_t kFeed = 0xAAAA;
  static constexpr uint32_t kStart = 0xCCCC;

  /// False when its clock does not start.
  [[nodiscard]] static bool start_clock() {
    using Oscillator = cortex_m::Register<OscillatorControl>;
    constexpr uint32_t kOn = 1u << 0;  // LSION
    constexpr uint32_t kReady = 1u << 1;
    Oscillator::set(kOn);
    return cortex_m::wait_until<Oscillator>(kReady, kReady);
  }

  /// 80 periods of 32 kHz / 4: 10 ms. Its clock runs already; false when the values do not arrive.
  [[nodiscard]] static bool set_ten_milliseconds() {
    constexpr uint32_t kUnlock = 0x5555;
    constexpr uint32_t kDivideByFour = 0;
    Key::write(kUnlock);
    Prescaler::write(kDivideByFour);
    Reload::write(80 - 1);
    return cortex_m::wait_until<Status>(3, 0);
  }
};

}  // namespace palpate::stm32
