// A DMA stream that fills a ring from a peripheral (RM0090, chapter 10; RM0433, chapter 15).
#pragma once

#include "register.hpp"

namespace palpate::stm32 {

template <uint32_t Controller, uint32_t Number>
struct DmaStream {
  static constexpr uint32_t kBase = Controller + 0x10 + 0x18 * Number;
  using Control = cortex_m::Register<kBase + 0x0>;  // SxCR
  using Left = cortex_m::Register<kBase + 0x4>;     // SxNDTR
  using Peripheral = cortex_m::Register<kBase + 0x8>;
  using Memory = cortex_m::Register<kBase + 0xC>;  // SxM0AR

  /// Bytes from the peripheral's register, round and round. `extra` are bits of SxCR that differ by family.
  static void fill_ring(uint32_t from, uint8_t* ring, uint32_t size, uint32_t extra) {
    constexpr uint32_t kIncrementMemory = 1u << 10;  // MINC; DIR = 00 is from the peripheral
    constexpr uint32_t kCircular = 1u << 8;
    constexpr uint32_t kEnable = 1u << 0;
    Control::write(0);
    Peripheral::write(from);
    Memory::write(static_cast<uint32_t>(reinterpret_cast<uintptr_t>(ring)));
    Left::write(size);
    Control::write(extra | kIncrementMemory | kCircular);
    Control::write(extra | kIncrementMemory | kCircular | kEnable);
  }
};

}  // namespace palpate::stm32
