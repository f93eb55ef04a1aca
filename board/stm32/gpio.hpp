// Pins (RM0090, chapter 8, GPIO; RM0433, chapter 11, GPIO: the same registers).
#pragma once

#include "register.hpp"

namespace palpate::stm32 {

template <uint32_t Base>
struct Gpio {
  using Mode = cortex_m::Register<Base + 0x00>;   // MODER: two bits a pin
  using Speed = cortex_m::Register<Base + 0x08>;  // OSPEEDR
  using Pull = cortex_m::Register<Base + 0x0C>;   // PUPDR
  using Input = cortex_m::Register<Base + 0x10>;  // IDR
  using SetReset =
      cortex_m::Register<Base + 0x18>;  // BSRR: a 1 in the low half sets, in the high half clears
  using FunctionLow = cortex_m::Register<Base + 0x20>;  // AFRL: four bits a pin
  using FunctionHigh = cortex_m::Register<Base + 0x24>;
};

/// BSRR's word that gives the pins this level.
constexpr uint32_t level_of(uint32_t pins, bool is_high) { return is_high ? pins : pins << 16; }

template <class Port, uint32_t Number>
struct Pin {
  static_assert(Number < 16);
  static constexpr uint32_t kMask = 1u << Number;

  static void make_input_with_pull_up() {
    Port::Pull::change(kTwoBits, kPullUp << kTwoBitShift);
    Port::Mode::change(kTwoBits, kInput << kTwoBitShift);
  }

  static void make_low_output() {
    Port::SetReset::write(level_of(kMask, false));
    Port::Mode::change(kTwoBits, kOutput << kTwoBitShift);
  }

  static void make_analog() { Port::Mode::change(kTwoBits, kAnalog << kTwoBitShift); }

  /// `function` is the number in the data sheet's table of alternate functions.
  static void make_alternate(uint32_t function) {
    constexpr uint32_t kShift = Number % 8 * 4;
    using Function =
        cortex_m::Register < Number<8 ? Port::FunctionLow::kAddress : Port::FunctionHigh::kAddress>;
    Function::change(15u << kShift, function << kShift);
    Port::Speed::change(kTwoBits, kMediumSpeed << kTwoBitShift);
    Port::Mode::change(kTwoBits, kAlternate << kTwoBitShift);
  }

  /// For a line that is high at rest, also with nothing plugged in.
  static void make_alternate_with_pull_up(uint32_t function) {
    Port::Pull::change(kTwoBits, kPullUp << kTwoBitShift);
    make_alternate(function);
  }

 private:
  static constexpr uint32_t kTwoBitShift = Number * 2;
  static constexpr uint32_t kTwoBits = 3u << kTwoBitShift;
  static constexpr uint32_t kInput = 0;
  static constexpr uint32_t kOutput = 1;
  static constexpr uint32_t kAlternate = 2;
  static constexpr uint32_t kAnalog = 3;
  static constexpr uint32_t kPullUp = 1;
  static constexpr uint32_t kMediumSpeed = 1;
};

}  // namespace palpate::stm32
