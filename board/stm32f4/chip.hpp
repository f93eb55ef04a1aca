// STM32F405 and F407: which unit and which pin does what. The page docs/porting/stm32f4.md has the wiring.
// Addresses: RM0090, 2.3 (memory map); alternate functions: the data sheet's table 9.
#pragma once

#include "dma_stream.hpp"
#include "gpio.hpp"
#include "independent_watchdog.hpp"
#include "timer.hpp"
#include "usart.hpp"

namespace palpate::stm32 {

using PortA = Gpio<0x4002'0000>;
using PortB = Gpio<0x4002'0400>;
using PortC = Gpio<0x4002'0800>;

using Encoder1 = Timer<0x4000'0400>;        // TIM3: PB4, PB5
using Encoder2 = Timer<0x4000'0C00>;        // TIM5: PA0, PA1
using Encoder3 = Timer<0x4000'0800>;        // TIM4: PB6, PB7
using MotorModulator = Timer<0x4001'0400>;  // TIM8: PC6, PC7, PC8

using AmplifierPort = PortB;
inline constexpr uint32_t kEnablePins = (1u << 12) | (1u << 13) | (1u << 14);
using WatchdogLine = Pin<PortB, 15>;
using LampPort = PortB;
using Lamp = Pin<PortB, 8>;

using InputPort = PortC;
using AmplifiersCut = Pin<PortC, 0>;
using SecondButton = Pin<PortC, 4>;
using GraspButton = Pin<PortC, 5>;
using EmergencyStop = Pin<PortC, 10>;
inline constexpr uint32_t kAmplifierFaultPins = (1u << 9) | (1u << 11) | (1u << 12);
inline constexpr uint32_t kSecondButton = 1u << 1;  // of read_buttons

using Watchdog = IndependentWatchdog<0x4000'3000, 0x4002'3874>;  // RCC_CSR: RM0090, 7.3.21
using ResetCause = cortex_m::Register<0x4002'3874>;              // RCC_CSR, RM0090, 7.3.21
inline constexpr uint32_t kResetByWatchdog = 1u << 29;           // IWDGRSTF
inline constexpr uint32_t kForgetResets = 1u << 24;              // RMVF

/// ADC1 (RM0090, 13.13).
struct GimbalConverter {
  static constexpr uint32_t kBase = 0x4001'2000;
  using Control1 = cortex_m::Register<kBase + 0x04>;
  using Control2 = cortex_m::Register<kBase + 0x08>;
  using SampleTimes1 = cortex_m::Register<kBase + 0x0C>;   // channels 10 to 18
  using SampleTimes2 = cortex_m::Register<kBase + 0x10>;   // channels 0 to 9
  using RegularLength = cortex_m::Register<kBase + 0x2C>;  // SQR1
  using RegularFirst = cortex_m::Register<kBase + 0x34>;   // SQR3
  using InjectedSequence = cortex_m::Register<kBase + 0x38>;
  using Injected1 = cortex_m::Register<kBase + 0x3C>;  // JDR1
  using Injected2 = cortex_m::Register<kBase + 0x40>;
  using Injected3 = cortex_m::Register<kBase + 0x44>;
  using CommonControl = cortex_m::Register<0x4001'2304>;
};

using Console = Usart<0x4000'4400>;  // USART2: PA2 sends, PA3 receives
using Link = Usart<0x4000'4800>;     // USART3: PB10 sends, PB11 receives
inline constexpr uint32_t kConsoleBaud = 460'800;
inline constexpr uint32_t kLinkBaud = 921'600;
using LinkReceiver = DmaStream<0x4002'6000, 1>;              // DMA1, stream 1
inline constexpr uint32_t kLinkReceiverSettings = 4u << 25;  // channel 4: USART3_RX (RM0090, table 42)

}  // namespace palpate::stm32
