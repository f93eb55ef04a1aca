// USART of the STM32H7 (RM0433, chapter 48).
#pragma once

#include "register.hpp"

namespace palpate::stm32 {

template <uint32_t Base>
struct Usart {
  using Control1 = cortex_m::Register<Base + 0x00>;
  using Control3 = cortex_m::Register<Base + 0x08>;
  using BaudDivider = cortex_m::Register<Base + 0x0C>;  // USART_BRR: clock / baud
  using Status = cortex_m::Register<Base + 0x1C>;       // USART_ISR
  using ReceiveData = cortex_m::Register<Base + 0x24>;
  using TransmitData = cortex_m::Register<Base + 0x28>;
  static constexpr uint32_t kTransmitReady = 1u << 7;  // ISR.TXFNF: room in the 16 bytes of the FIFO

  /// 8 bits, no parity, one stop bit; received bytes are asked for by DMA, and a byte too much is lost alone.
  static void start(uint32_t divider) {
    constexpr uint32_t kReceiverUsesDma = 1u << 6;         // CR3.DMAR
    constexpr uint32_t kGoOnAfterOverrun = 1u << 12;       // CR3.OVRDIS
    constexpr uint32_t kFifo = 1u << 29;                   // CR1.FIFOEN
    constexpr uint32_t kBothWays = (1u << 3) | (1u << 2);  // CR1.TE, RE
    constexpr uint32_t kEnable = 1u << 0;                  // CR1.UE
    BaudDivider::write(divider);
    Control3::write(kGoOnAfterOverrun | kReceiverUsesDma);
    Control1::write(kFifo | kBothWays);
    Control1::write(kFifo | kBothWays | kEnable);
  }
};

}  // namespace palpate::stm32
