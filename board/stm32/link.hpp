// The link's receiver.
#pragma once

namespace palpate::stm32 {

/// Bytes then arrive in a ring. The link's USART is set up already, and its DMA controller has its clock.
void start_link_receiver();

}  // namespace palpate::stm32
