// Where what is in a container: a file header, chunks, and a chunk END that seals them. One format for
// models, snapshots and recordings; docs/container-format.md shows it in tables and with an example in hex.
//
//   file header, 16 bytes            chunk, a multiple of 8 bytes
//     0  magic, 8 bytes                0          tag, four characters
//     8  u16 format version            4          u16 version of this chunk
//    10  u8  kind                      6          u16 flags, bit 0: required
//    11  u8  zero                      8          u32 length of the payload
//    12  u32 CRC-32C of all before    12          u32 CRC-32C of the 12 bytes before
//                                     16          payload
//                                     16 + length zeros, 0 to 7
//                                     end - 4     u32 CRC-32C of 0 to 11 and of 16 to here
//
// A header has a check of its own so that a damaged length is told from a file that was cut off. The other
// one stands behind the payload, so that a writer needs no memory for it. It leaves the header's check out:
// what a CRC says of bytes with their own CRC behind them is the same for all bytes.
#pragma once

#include "palpate/container/bytes.hpp"

namespace palpate::container {

/// What a transfer as text does to it shows: the first byte has bit 7, CR LF and LF are line ends of two
/// systems, and 0x1a ends a text for some.
inline constexpr uint8_t kMagic[8] = {0x89, 'P', 'L', 'P', '\r', '\n', 0x1a, '\n'};
inline constexpr uint16_t kFormatVersion = 1;

enum class Kind : uint8_t { kModel = 1, kSnapshot = 2, kRecording = 3 };
inline constexpr Kind kLastKind = Kind::kRecording;

/// Four characters that name a chunk.
struct Tag {
  uint32_t word;  // the first character in the low byte

  static constexpr Tag of(const char (&text)[5]) {
    const auto at = [&text](int i) { return static_cast<uint32_t>(static_cast<uint8_t>(text[i])); };
    return Tag{at(0) | at(1) << 8 | at(2) << 16 | at(3) << 24};
  }
  [[nodiscard]] constexpr char at(uint32_t i) const {
    return static_cast<char>(static_cast<uint8_t>(word >> (8 * i)));
  }
  friend constexpr bool operator==(Tag a, Tag b) { return a.word == b.word; }
  friend constexpr bool operator!=(Tag a, Tag b) { return a.word != b.word; }
};

inline constexpr Tag kNoTag{0};  // in the file header
inline constexpr Tag kEndTag = Tag::of("END ");
inline constexpr uint16_t kEndVersion = 1;
/// u32 number of chunks before END, u32 CRC-32C of the file header's check and then of theirs, in order.
inline constexpr uint32_t kEndPayloadBytes = 8;

/// A reader that does not know a required chunk must refuse the file; it skips others.
inline constexpr uint16_t kRequiredFlag = 1;

inline constexpr uint32_t kFileHeaderBytes = 16;
inline constexpr uint32_t kChunkHeaderBytes = 16;
inline constexpr uint32_t kCheckBytes = 4;
inline constexpr uint32_t kMostPayloadBytes = 1u << 20;
/// Beside END.
inline constexpr uint32_t kMostChunks = 1u << 17;

/// Zeros behind a payload.
constexpr uint32_t padding_bytes(uint32_t length) { return (8u - (length + kCheckBytes) % 8u) % 8u; }
/// All of a chunk, header and check included.
constexpr uint32_t chunk_bytes(uint32_t length) {
  return kChunkHeaderBytes + length + padding_bytes(length) + kCheckBytes;
}

}  // namespace palpate::container
