// STM32H743: which unit and which pin does what. The page docs/porting/stm32h743.md has the wiring.
// Addresses: RM0433, 2.3 (memory map); alternate functions: the data sheet's tables 10 to 14.
#pragma once

#include "dma_stream.hpp"
#include "gpio.hpp"
#include "independent_watchdog.hpp"
#include "timer.hpp"
#include "usart.hpp"

namespace palpate::stm32 {

using PortA = Gpio<0x5802'0000>;
using PortB = Gpio<0x5802'0400>;
using PortC = Gpio<0x5802'0800>;
using PortD = Gpio<0x5802'0C00>;
using PortE = Gpio<0x5802'1000>;

using Encoder1 = Timer<0x4000'0400>;        // TIM3: PB4, PB5
using Encoder2 = Timer<0x4000'0800>;        // TIM4: PD12, PD13
using Encoder3 = Timer<0x4001'0400>;        // TIM8: PC6, PC7
using MotorModulator = Timer<0x4001'0000>;  // TIM1: PE9, PE11, PE13

using AmplifierPort = PortE;
inline constexpr uint32_t kEnablePins = (1u << 10) | (1u << 12) | (1u << 14);
using WatchdogLine = Pin<PortE, 15>;
using LampPort = PortB;
using Lamp = Pin<PortB, 0>;  // LD1 of the NUCLEO

using InputPort = PortE;
using EmergencyStop = Pin<PortE, 2>;
using AmplifiersCut = Pin<PortE, 3>;
inline constexpr uint32_t kAmplifierFaultPins = (1u << 4) | (1u << 5) | (1u << 6);
using GraspButton = Pin<PortE, 7>;
using SecondButton = Pin<PortE, 8>;
inline constexpr uint32_t kSecondButton = 1u << 1;  // of read_buttons

using Watchdog = IndependentWatchdog<0x5800'4800, 0x5802'4474>;  // IWDG1
using ResetCause = cortex_m::Register<0x5802'44D0>;              // RCC_RSR, RM0433, chapter 8
inline constexpr uint32_t kResetByWatchdog = 1u << 26;           // IWDG1RSTF
inline constexpr uint32_t kForgetResets = 1u << 16;              // RMVF

/// ADC1 (RM0433, chapter 25).
struct GimbalConverter {
  static constexpr uint32_t kBase = 0x4002'2000;
  using Status = cortex_m::Register<kBase + 0x00>;   // ADC_ISR
  using Control = cortex_m::Register<kBase + 0x08>;  // ADC_CR
  using Configuration = cortex_m::Register<kBase + 0x0C>;
  using SampleTimes1 = cortex_m::Register<kBase + 0x14>;  // channels 0 to 9
  using SampleTimes2 = cortex_m::Register<kBase + 0x18>;  // channels 10 to 19
  using Preselection = cortex_m::Register<kBase + 0x1C>;
  using RegularSequence = cortex_m::Register<kBase + 0x30>;  // SQR1
  using InjectedSequence = cortex_m::Register<kBase + 0x4C>;
  using Injected1 = cortex_m::Register<kBase + 0x80>;  // JDR1
  using Injected2 = cortex_m::Register<kBase + 0x84>;
  using Injected3 = cortex_m::Register<kBase + 0x88>;
  using CommonControl = cortex_m::Register<0x4002'2308>;
};

using Console =
    Usart<0x4000'4800>;           // USART3: PD8 sends, PD9 receives; the NUCLEO's ST-LINK is at the other end
using Link = Usart<0x4000'4400>;  // USART2: PD5 sends, PD6 receives
inline constexpr uint32_t kConsoleBaud = 460'800;
inline constexpr uint32_t kLinkBaud = 921'600;
using LinkReceiver = DmaStream<0x4002'0000, 0>;  // DMA1, stream 0; its request: connect_link_receiver
// TRBUFF: without it a stream can stop for good at a USART (errata ES0392).
inline constexpr uint32_t kLinkReceiverSettings = 1u << 20;

}  // namespace palpate::stm32
