// Frames to bytes.
#pragma once

#include "palpate/link/cobs.hpp"
#include "palpate/link/frame.hpp"

namespace palpate::link {

/// It numbers the frames of each type; the first one after a start has the number 0. Of one type only one
/// writer sends.
class FrameWriter {
 public:
  /// The whole frame, with both of its zeros. It can't fail. 28 steps of COBS, 58 of the CRC.
  void write(MessageType type, const Payload& payload, WireFrame& wire) {
    std::array<uint8_t, kBodySize> body;
    body[0] = kVersion;
    body[1] = static_cast<uint8_t>(type);
    uint16_t& next_sequence = next_sequence_[static_cast<std::size_t>(type)];
    body[2] = static_cast<uint8_t>(next_sequence & 0xffu);
    body[3] = static_cast<uint8_t>(next_sequence >> 8);
    ++next_sequence;
    for (const uint32_t i : bounded<kPayloadSize>(kPayloadSize, [] {})) body[kHeaderSize + i] = payload[i];

    std::array<uint8_t, kEncodedSize> encoded;
    cobs_encode(body, encoded);
    Crc16 crc;
    wire[0] = 0;
    for (const uint32_t i : bounded<kEncodedSize>(kEncodedSize, [] {})) {
      wire[1 + i] = encoded[i];
      crc.add(encoded[i]);
    }
    const uint32_t check = check_field(crc.value());
    wire[1 + kEncodedSize] = static_cast<uint8_t>(check >> 16);
    wire[2 + kEncodedSize] = static_cast<uint8_t>(check >> 8 & 0xffu);
    wire[3 + kEncodedSize] = static_cast<uint8_t>(check & 0xffu);
    wire[kWireSize - 1] = 0;
  }

 private:
  std::array<uint16_t, kTypePlaces> next_sequence_{};
};

}  // namespace palpate::link
