// i.MX RT1062: units and their registers, as far as they are used here (IMXRT1060RM; each name is the
// manual's chapter). The page docs/porting/imxrt1062.md has the wiring.
#pragma once

#include "register.hpp"

namespace palpate::imxrt {

using cortex_m::HalfRegister;
using cortex_m::Register;

/// GPIO at its fast address.
template <uint32_t Base>
struct Gpio {
  using Direction = Register<Base + 0x04>;  // GDIR
  using Input = Register<Base + 0x08>;      // PSR
  using Set = Register<Base + 0x84>;        // DR_SET
  using Clear = Register<Base + 0x88>;      // DR_CLEAR
  using Toggle = Register<Base + 0x8C>;     // DR_TOGGLE
};

/// ENC: a quadrature decoder.
template <uint32_t Base>
struct Decoder {
  using Control = HalfRegister<Base + 0x00>;
  using Filter = HalfRegister<Base + 0x02>;
  using CountLow = HalfRegister<Base + 0x10>;  // LPOS
  using StartHigh = HalfRegister<Base + 0x16>;
  using StartLow = HalfRegister<Base + 0x18>;

  /// Counts all four edges, from 0. Four equal samples, 8 bus clocks apart: 0.2 us at 150 MHz.
  static void start() {
    constexpr uint32_t kFilter = (1u << 8) | 8;  // FILT_CNT, FILT_PER
    constexpr uint32_t kLoadStart = 1u << 11;    // SWIP
    Filter::write(kFilter);
    StartHigh::write(0);
    StartLow::write(0);
    Control::write(kLoadStart);
  }
};

/// LPUART.
template <uint32_t Base>
struct Uart {
  using Baud = Register<Base + 0x10>;
  using Status = Register<Base + 0x14>;
  using Control = Register<Base + 0x18>;
  using Data = Register<Base + 0x1C>;
  using Fifo = Register<Base + 0x28>;
  static constexpr uint32_t kTransmitReady = 1u << 23;  // TDRE
  static constexpr uint32_t kOverrun = 1u << 19;        // OR: nothing more comes until it is cleared

  /// From 24 MHz: oversampling 26 times, so 923077 baud by `divider`. Received bytes are asked for by DMA.
  static void start(uint32_t divider) {
    constexpr uint32_t kReceiverUsesDma = 1u << 21;          // RDMAE
    constexpr uint32_t kOversampling = (26u - 1) << 24;      // OSR
    constexpr uint32_t kReceiveFifo = 1u << 3;               // RXFE: four bytes
    constexpr uint32_t kBothWays = (1u << 19) | (1u << 18);  // TE, RE
    Control::write(0);
    Baud::write(kOversampling | kReceiverUsesDma | divider);
    Fifo::write(kReceiveFifo);
    Control::write(kBothWays);
  }
};

/// eFlexPWM.
template <uint32_t Base>
struct Modulator {
  using Outputs = HalfRegister<Base + 0x180>;        // OUTEN
  using MasterControl = HalfRegister<Base + 0x188>;  // MCTRL
  using FaultControl = HalfRegister<Base + 0x18C>;   // FCTRL0
  using FaultStatus = HalfRegister<Base + 0x18E>;    // FSTS0
  static constexpr uint32_t kSubmodules = 7;         // 0 to 2
  /// LDOK and RUN: new values hold from the next period on, all of them.
  static constexpr uint32_t kLoad = (kSubmodules << 8) | kSubmodules;

  template <uint32_t Number>
  struct Submodule {
    static constexpr uint32_t kBase = Base + 0x60 * Number;
    using Start = HalfRegister<kBase + 0x02>;     // INIT
    using Control2 = HalfRegister<kBase + 0x04>;  // CTRL2
    using Control = HalfRegister<kBase + 0x06>;   // CTRL
    using Last = HalfRegister<kBase + 0x0E>;      // VAL1
    using Rise = HalfRegister<kBase + 0x12>;      // VAL2
    using Fall = HalfRegister<kBase + 0x16>;      // VAL3
    using Polarity = HalfRegister<kBase + 0x22>;  // OCTRL
    using FaultMap = HalfRegister<kBase + 0x2C>;  // DISMAP0

    static void set_up(uint32_t steps) {
      // INDEP; WAITEN and DBGEN: it goes on while the processor sleeps or a debugger halts it. A modulator
      // that stops leaves its output low, and that is full current.
      constexpr uint32_t kIndependentAndAlways = (1u << 15) | (1u << 14) | (1u << 13);
      constexpr uint32_t kReloadEveryPeriod = 1u << 10;  // FULL
      Control2::write(kIndependentAndAlways);
      Control::write(kReloadEveryPeriod);
      Polarity::write(0);
      FaultMap::write(0xF000);  // no fault input stops it; the high bits are always 1
      Start::write(0);
      Last::write(4095);
      Rise::write(0);
      Fall::write(steps);
    }
  };
};

/// ADC1. It converts one channel for each request.
struct GimbalConverter {
  static constexpr uint32_t kBase = 0x400C'4000;
  using Request = Register<kBase + 0x00>;  // HC0: writing a channel starts a conversion
  using Result = Register<kBase + 0x24>;   // R0
  using Configuration = Register<kBase + 0x44>;
  using GeneralControl = Register<kBase + 0x48>;
  using GeneralStatus = Register<kBase + 0x4C>;

  /// ADC1_IN6, IN5, IN15: one nibble each.
  static constexpr uint32_t channel_of(uint32_t joint) { return (0xF56u >> (4 * joint)) & 15; }
};

using InputPort = Gpio<0x4200'0000>;      // GPIO6, which shares its pins with GPIO1
using AmplifierPort = Gpio<0x4200'4000>;  // GPIO7, with GPIO2
using Encoder1 = Decoder<0x403C'8000>;    // ENC1
using Encoder2 = Decoder<0x403C'C000>;
using Encoder3 = Decoder<0x403D'0000>;
using MotorModulator = Modulator<0x403E'0000>;  // PWM2
using Motor1 = MotorModulator::Submodule<0>;
using Motor2 = MotorModulator::Submodule<1>;
using Motor3 = MotorModulator::Submodule<2>;
using Console = Uart<0x4018'4000>;              // LPUART1
using Link = Uart<0x4019'0000>;                 // LPUART4
inline constexpr uint32_t kConsoleDivider = 2;  // 460800 baud
inline constexpr uint32_t kLinkDivider = 1;     // 921600 baud

// Bits of AmplifierPort.
inline constexpr uint32_t kEnablePins = (1u << 0) | (1u << 1) | (1u << 2);
inline constexpr uint32_t kWatchdogLine = 1u << 11;
inline constexpr uint32_t kLamp = 1u << 3;
// Bits of InputPort.
inline constexpr uint32_t kEmergencyStopPin = 1u << 18;
inline constexpr uint32_t kAmplifierFaultPins = (1u << 19) | (1u << 22) | (1u << 23);
inline constexpr uint32_t kAmplifiersCutPin = 1u << 27;
inline constexpr uint32_t kGraspButtonPin = 1u << 24;
inline constexpr uint32_t kSecondButtonPin = 1u << 25;
inline constexpr uint32_t kSecondButton = 1u << 1;  // of read_buttons

/// RTWDOG (WDOG3).
struct Watchdog {
  using Control = Register<0x400B'C000>;  // CS
  using Counter = Register<0x400B'C004>;  // CNT
  using Timeout = Register<0x400B'C008>;  // TOVAL
  static constexpr uint32_t kUnlock = 0xD928'C520;
  static constexpr uint32_t kFeed = 0xB480'A602;
};

/// Clocks of everything, and those of the processor. False when it does not run at 600 MHz.
[[nodiscard]] bool initialize_clocks();
void initialize_pins();
/// The motors' pins, when their signal is that of no current.
void connect_motors();
void start_motor_modulator();
[[nodiscard]] bool start_gimbal_converter();
void start_link_receiver();

}  // namespace palpate::imxrt
