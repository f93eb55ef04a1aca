// The frame of the wire protocol, the same 34 bytes for every message (docs/wire-protocol.md):
//
//   00 | COBS of: version, type, sequence number (2, low byte first), payload (24) | check (3) | 00
//
// The check covers what travels: the 29 bytes that COBS made, so that a wrong distance among them is a few
// wrong bits like any other and not a frame of other bytes. Its three bytes are never 0, so they need no
// COBS of their own, and their upper two bits are set, so that a frame that has slipped by a byte shows it.
// With one length for all, no part of a frame can be a frame.
#pragma once

#include "palpate/link/crc16.hpp"

namespace palpate::link {

inline constexpr uint8_t kVersion = 1;

inline constexpr std::size_t kHeaderSize = 4;
inline constexpr std::size_t kPayloadSize = 24;
inline constexpr std::size_t kBodySize = kHeaderSize + kPayloadSize;
inline constexpr std::size_t kEncodedSize = kBodySize + 1;
inline constexpr std::size_t kCheckSize = 3;
inline constexpr std::size_t kPieceSize = kEncodedSize + kCheckSize;  ///< between two zeros
inline constexpr std::size_t kWireSize = kPieceSize + 2;              ///< with both of them
static_assert(kEncodedSize <= kCrc16CoveredBytes, "palpate: longer frames would lose CRC distance");

/// Numbers are never used again for something else.
enum class MessageType : uint8_t {
  kSensors = 1,
  kActuators = 2,
  kCommand = 3,
  kTelemetry = 4,
  kStageCycles = 5,
  kCounters = 6,
  kMotors = 7,
  kInputs = 8
};
inline constexpr MessageType kLastMessageType = MessageType::kInputs;
/// A place for each type, and for the 0 that is none.
inline constexpr std::size_t kTypePlaces = static_cast<std::size_t>(kLastMessageType) + 1;

constexpr bool is_known(MessageType type) {
  return type >= MessageType::kSensors && type <= kLastMessageType;
}

using Payload = std::array<uint8_t, kPayloadSize>;
using WireFrame = std::array<uint8_t, kWireSize>;

struct Frame {
  MessageType type;
  uint16_t sequence;  ///< counts the frames of this type, modulo 2^16
  Payload payload;
};

/// The three check bytes, the first one in bits 16..23: 0xc0 + the CRC's upper 4, middle 6 and lower 6 bits.
constexpr uint32_t check_field(uint16_t crc) {
  const uint32_t bits = crc;
  return 0xc0c0c0u | (bits & 0xf000u) << 4 | (bits & 0x0fc0u) << 2 | (bits & 0x003fu);
}

}  // namespace palpate::link
