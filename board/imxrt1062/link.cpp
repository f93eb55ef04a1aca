// The link: a DMA channel puts what comes into a ring, without an interrupt; the background takes it from
// there (IMXRT1060RM, chapters eDMA and DMAMUX). At 921600 baud a tick brings 92 bytes, so that 1024 last
// while the background is away for 11 ticks.
#include "palpate/ports/link.hpp"

#include "receive_ring.hpp"
#include "units.hpp"

namespace palpate::imxrt {
namespace {

constexpr uint32_t kRingBytes = 1024;
[[gnu::section(".dma")]] std::array<volatile uint8_t, kRingBytes> g_ring;
device::RingReader<kRingBytes> g_reader;

using RequestEnable = Register<0x400E'800C>;   // DMA_ERQ
using Multiplexer0 = Register<0x400E'C000>;    // DMAMUX_CHCFG0
constexpr uint32_t kDescriptor = 0x400E'9000;  // TCD0
using Source = Register<kDescriptor + 0x00>;
using SourceStep = Register<kDescriptor + 0x04>;  // SOFF and ATTR
using BytesARequest = Register<kDescriptor + 0x08>;
using SourceAtEnd = Register<kDescriptor + 0x0C>;
using Destination = Register<kDescriptor + 0x10>;
using DestinationStep = Register<kDescriptor + 0x14>;  // DOFF and CITER
using DestinationAtEnd = Register<kDescriptor + 0x18>;
using ControlAndCount = Register<kDescriptor + 0x1C>;  // CSR and BITER

uint32_t ring_address() { return static_cast<uint32_t>(reinterpret_cast<uintptr_t>(g_ring.data())); }

}  // namespace

void start_link_receiver() {
  constexpr uint32_t kOn = 1u << 31;
  constexpr uint32_t kLinkReceives = 69;  // LPUART4, table of DMA requests
  Multiplexer0::write(0);
  Source::write(Link::Data::kAddress);
  SourceStep::write(0);  // stays; bytes on both sides
  BytesARequest::write(1);
  SourceAtEnd::write(0);
  Destination::write(ring_address());
  DestinationStep::write((kRingBytes << 16) | 1);
  DestinationAtEnd::write(0u - kRingBytes);
  ControlAndCount::write(kRingBytes << 16);  // no interrupt, and no end
  RequestEnable::set(1u << 0);
  Multiplexer0::write(kOn | kLinkReceives);
}

}  // namespace palpate::imxrt

namespace palpate::port {

bool receive_byte(uint8_t& byte) {
  // Until it is cleared an overrun keeps everything out; the other flags stay as they are when a 0 is
  // written.
  if ((imxrt::Link::Status::read() & imxrt::Link::kOverrun) != 0) {
    imxrt::Link::Status::write(imxrt::Link::kOverrun);
  }
  const uint32_t index = imxrt::g_reader.next(imxrt::Destination::read() - imxrt::ring_address());
  if (index == imxrt::kRingBytes) return false;
  byte = imxrt::g_ring[index];
  return true;
}

bool link_carries_device() { return false; }

bool send_byte(uint8_t byte) {
  if ((imxrt::Link::Status::read() & imxrt::Link::kTransmitReady) == 0) return false;
  imxrt::Link::Data::write(byte);
  return true;
}

}  // namespace palpate::port
