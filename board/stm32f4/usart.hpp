// USART of the STM32F4 (RM0090, 30.6).
#pragma once

#include "register.hpp"

namespace palpate::stm32 {

template <uint32_t Base>
struct Usart {
  using Status = cortex_m::Register<Base + 0x00>;        // USART_SR
  using ReceiveData = cortex_m::Register<Base + 0x04>;   // USART_DR
  using TransmitData = cortex_m::Register<Base + 0x04>;  // the same register
  using BaudDivider = cortex_m::Register<Base + 0x08>;   // USART_BRR: sixteenths, so clock / baud
  using Control1 = cortex_m::Register<Base + 0x0C>;
  using Control3 = cortex_m::Register<Base + 0x14>;
  static constexpr uint32_t kTransmitReady = 1u << 7;  // SR.TXE

  /// 8 bits, no parity, one stop bit; received bytes are asked for by DMA.
  static void start(uint32_t divider) {
    constexpr uint32_t kReceiverUsesDma = 1u << 6;                            // CR3.DMAR
    constexpr uint32_t kEnableBothWays = (1u << 13) | (1u << 3) | (1u << 2);  // CR1.UE, TE, RE
    BaudDivider::write(divider);
    Control3::write(kReceiverUsesDma);
    Control1::write(kEnableBothWays);
  }
};

}  // namespace palpate::stm32
