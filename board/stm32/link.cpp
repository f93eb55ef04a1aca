// The link: a DMA stream puts what comes into a ring, without an interrupt; the background takes it from
// there. At 921600 baud a tick brings 92 bytes, so that 1024 last while the background is away for 11 ticks.
#include "link.hpp"

#include "chip.hpp"
#include "palpate/ports/link.hpp"
#include "receive_ring.hpp"

namespace palpate::stm32 {
namespace {

constexpr uint32_t kRingBytes = 1024;
// Where the DMA controller reaches: the memories beside the core are out of its way.
[[gnu::section(".dma")]] std::array<volatile uint8_t, kRingBytes> g_ring;
device::RingReader<kRingBytes> g_reader;

}  // namespace

void start_link_receiver() {
  LinkReceiver::fill_ring(Link::ReceiveData::kAddress, const_cast<uint8_t*>(g_ring.data()), kRingBytes,
                          kLinkReceiverSettings);
}

}  // namespace palpate::stm32

namespace palpate::port {

bool receive_byte(uint8_t& byte) {
  const uint32_t index = stm32::g_reader.next(stm32::kRingBytes - stm32::LinkReceiver::Left::read());
  if (index == stm32::kRingBytes) return false;
  byte = stm32::g_ring[index];
  return true;
}

bool link_carries_device() { return false; }

bool send_byte(uint8_t byte) {
  if ((stm32::Link::Status::read() & stm32::Link::kTransmitReady) == 0) return false;
  stm32::Link::TransmitData::write(byte);
  return true;
}

}  // namespace palpate::port
