// Device registers of the MPS2 boards' FPGA images, as far as they are used here.
#pragma once

#include "system_registers.hpp"

namespace palpate::mps2 {

using cortex_m::Register;

/// CMSDK APB timer: counts down from its reload value at the peripheral clock.
template <uint32_t Base>
struct CmsdkTimer {
  using Control = Register<Base + 0x0>;
  using Value = Register<Base + 0x4>;
  using Reload = Register<Base + 0x8>;
  using Interrupt = Register<Base + 0xC>;  // reads the request; writing 1 clears it
  static constexpr uint32_t kEnable = 1u << 0;
  static constexpr uint32_t kInterruptEnable = 1u << 3;
};

/// CMSDK APB UART.
template <uint32_t Base>
struct CmsdkUart {
  using Data = Register<Base + 0x0>;
  using State = Register<Base + 0x4>;
  using Control = Register<Base + 0x8>;
  using BaudDivider = Register<Base + 0x10>;
  static constexpr uint32_t kTransmitFull = 1u << 0;  // of State
  static constexpr uint32_t kReceiveFull = 1u << 1;
  static constexpr uint32_t kTransmitEnable = 1u << 0;  // of Control
  static constexpr uint32_t kReceiveEnable = 1u << 1;
};

inline constexpr uint32_t kPeripheralClockHz = 25'000'000;

using TickTimer = CmsdkTimer<0x4000'0000>;
using FreeTimer = CmsdkTimer<0x4000'1000>;
using ConsoleUart = CmsdkUart<0x4000'4000>;
using LinkUart = CmsdkUart<0x4000'5000>;

/// What differs between the processors; each board defines it.
void initialize_core();

}  // namespace palpate::mps2
