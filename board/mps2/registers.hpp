// Device registers of the MPS2 boards' FPGA images and of the Cortex-M system space, as far as they are used
// here.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::mps2 {

/// The 32-bit register at an address that is known when the program is built.
template <uint32_t Address>
struct Register {
  PALPATE_ALWAYS_INLINE static uint32_t read() { return *pointer(); }
  PALPATE_ALWAYS_INLINE static void write(uint32_t value) { *pointer() = value; }

 private:
  PALPATE_ALWAYS_INLINE static volatile uint32_t* pointer() {
    return reinterpret_cast<volatile uint32_t*>(Address);  // NOLINT(performance-no-int-to-ptr)
  }
};

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
  static constexpr uint32_t kTransmitFull = 1u << 0;
  static constexpr uint32_t kTransmitEnable = 1u << 0;
};

inline constexpr uint32_t kPeripheralClockHz = 25'000'000;

using TickTimer = CmsdkTimer<0x4000'0000>;
using FreeTimer = CmsdkTimer<0x4000'1000>;
using ConsoleUart = CmsdkUart<0x4000'4000>;
inline constexpr uint32_t kTickInterrupt = 8;  // timer 0

using NvicSetEnable = Register<0xE000'E100>;
using NvicClearPending = Register<0xE000'E280>;
using AuxiliaryControl = Register<0xE000'E008>;
using ConfigurationControl = Register<0xE000'ED14>;
using ConfigurableFaultStatus = Register<0xE000'ED28>;
using HardFaultStatus = Register<0xE000'ED2C>;
using MemoryFaultAddress = Register<0xE000'ED34>;
using BusFaultAddress = Register<0xE000'ED38>;
using MpuControl = Register<0xE000'ED94>;
using MpuRegionNumber = Register<0xE000'ED98>;
using MpuRegionBase = Register<0xE000'ED9C>;
using MpuRegionAttributes = Register<0xE000'EDA0>;

PALPATE_ALWAYS_INLINE void synchronize() { asm volatile("dsb\n\tisb" ::: "memory"); }

/// What differs between the processors; each board defines it.
void initialize_core();

}  // namespace palpate::mps2
