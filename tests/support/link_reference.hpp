// The wire protocol again, from its document: whole streams, bit by bit, without a thought for speed. The
// tests compare the firmware's reader and writer with it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "palpate/link/frame_reader.hpp"
#include "palpate/link/frame_writer.hpp"
#include "support/random.hpp"

namespace palpate::test {

using Bytes = std::vector<uint8_t>;

/// The remainder of (message with its first 16 bits inverted) x^16, by long division.
inline uint16_t reference_crc(const Bytes& message) {
  Bytes dividend = message;
  dividend.insert(dividend.end(), 2, 0);
  for (std::size_t i = 0; i < 2; ++i) dividend[i] ^= 0xff;
  uint32_t remainder = 0;
  for (std::size_t bit = 0; bit < 8 * dividend.size(); ++bit) {
    remainder = remainder << 1 | (dividend[bit / 8] >> (7 - bit % 8) & 1u);
    if ((remainder & 0x10000u) != 0) remainder ^= 0x15935u;
  }
  return static_cast<uint16_t>(remainder);
}

/// Groups between zeros, each after its length plus one.
inline Bytes reference_cobs(const Bytes& plain) {
  Bytes encoded;
  auto begin = plain.begin();
  while (true) {
    const auto zero = std::find(begin, plain.end(), uint8_t{0});
    encoded.push_back(static_cast<uint8_t>(zero - begin + 1));
    encoded.insert(encoded.end(), begin, zero);
    if (zero == plain.end()) return encoded;
    begin = zero + 1;
  }
}

/// Nothing when the last distance does not point to the end.
inline std::optional<Bytes> reference_cobs_decoded(const Bytes& encoded) {
  Bytes plain;
  for (std::size_t at = 0; at < encoded.size();) {
    const std::size_t next = at + encoded[at];
    if (next > encoded.size()) return std::nullopt;
    if (at != 0) plain.push_back(0);
    for (std::size_t i = at + 1; i < next; ++i) plain.push_back(encoded[i]);
    at = next;
  }
  return plain;
}

inline Bytes check_bytes(const Bytes& encoded) {
  const uint32_t crc = encoded.size() < 2 ? 0 : reference_crc(encoded);
  return {static_cast<uint8_t>(0xc0 + crc / 4096), static_cast<uint8_t>(0xc0 + crc / 64 % 64),
          static_cast<uint8_t>(0xc0 + crc % 64)};
}

/// The piece between two zeros that carries these bytes, however many and whatever they are.
inline Bytes reference_piece(const Bytes& body) {
  Bytes piece = reference_cobs(body);
  const Bytes check = check_bytes(piece);
  piece.insert(piece.end(), check.begin(), check.end());
  return piece;
}

inline Bytes between_zeros(Bytes piece) {
  piece.insert(piece.begin(), 0);
  piece.push_back(0);
  return piece;
}

inline Bytes reference_body(uint8_t version, uint8_t type, uint16_t sequence, const Bytes& payload) {
  Bytes body = {version, type, static_cast<uint8_t>(sequence % 256), static_cast<uint8_t>(sequence / 256)};
  body.insert(body.end(), payload.begin(), payload.end());
  return body;
}

/// What a reader makes of a stream.
struct Reading {
  std::vector<link::Frame> frames;
  link::ReaderCounters counters{};
};

inline void append(Bytes& stream, const Bytes& more) {
  stream.insert(stream.end(), more.begin(), more.end());
}

inline void count_sequence(const Reading& reading, const link::Frame& next, link::ReaderCounters& counters) {
  const auto last = std::find_if(reading.frames.rbegin(), reading.frames.rend(),
                                 [&next](const link::Frame& frame) { return frame.type == next.type; });
  if (last == reading.frames.rend()) return;
  const uint32_t ahead = (next.sequence + 65535u - last->sequence) % 65536u;
  if (ahead < 32768) {
    counters.lost_frames += ahead;
  } else {
    ++counters.restarts;
  }
}

/// The counter of a piece; `body` receives what was accepted.
inline uint32_t& reference_verdict(const Bytes& piece, Bytes& body, link::ReaderCounters& counters) {
  if (piece.size() != 32) return counters.bad_lengths;
  const Bytes encoded(piece.begin(), piece.end() - 3);
  if (check_bytes(encoded) != Bytes(piece.end() - 3, piece.end())) return counters.crc_failures;
  const std::optional<Bytes> decoded = reference_cobs_decoded(encoded);
  if (!decoded) return counters.bad_blocks;
  body = *decoded;
  if (body[0] != 1) return counters.bad_versions;
  if (body[1] < 1 || body[1] > 8) return counters.bad_types;
  return counters.accepted;
}

/// Cuts the stream at its zeros. What stands behind the last one is no piece yet, but bytes beyond the 32nd
/// are discarded as they come.
inline Reading reference_read(const Bytes& stream) {
  Reading reading;
  link::ReaderCounters& counters = reading.counters;
  auto begin = stream.begin();
  while (true) {
    const auto zero = std::find(begin, stream.end(), uint8_t{0});
    const Bytes piece(begin, zero);
    if (zero == stream.end()) {
      counters.discarded_bytes += static_cast<uint32_t>(piece.size() > 32 ? piece.size() - 32 : 0);
      return reading;
    }
    begin = zero + 1;
    if (piece.empty()) continue;
    Bytes body;
    uint32_t& count = reference_verdict(piece, body, counters);
    ++count;
    if (&count != &counters.accepted) {
      counters.discarded_bytes += static_cast<uint32_t>(piece.size());
      continue;
    }
    link::Frame frame{
        static_cast<link::MessageType>(body[1]), static_cast<uint16_t>(body[2] + 256 * body[3]), {}};
    std::copy(body.begin() + 4, body.end(), frame.payload.begin());
    count_sequence(reading, frame, counters);
    reading.frames.push_back(frame);
  }
}

inline Reading read_on(link::FrameReader& reader, const Bytes& stream) {
  Reading reading;
  for (const uint8_t byte : stream) {
    if (reader.push(byte)) reading.frames.push_back(reader.frame());
  }
  reading.counters = reader.counters();
  return reading;
}

/// By the firmware's reader, new.
inline Reading read_stream(const Bytes& stream) {
  link::FrameReader reader;
  return read_on(reader, stream);
}

inline std::array<uint32_t, 9> listed(const link::ReaderCounters& c) {
  return {c.accepted,  c.bad_lengths, c.crc_failures, c.bad_blocks,     c.bad_versions,
          c.bad_types, c.lost_frames, c.restarts,     c.discarded_bytes};
}

inline bool is_same(const link::Frame& a, const link::Frame& b) {
  return a.type == b.type && a.sequence == b.sequence && a.payload == b.payload;
}

inline bool is_same(const Reading& a, const Reading& b) {
  return listed(a.counters) == listed(b.counters) &&
         std::equal(a.frames.begin(), a.frames.end(), b.frames.begin(), b.frames.end(),
                    [](const link::Frame& x, const link::Frame& y) { return is_same(x, y); });
}

/// By the firmware's writer.
inline Bytes written(link::FrameWriter& writer, link::MessageType type, const link::Payload& payload) {
  link::WireFrame wire{};
  writer.write(type, payload, wire);
  return {wire.begin(), wire.end()};
}

/// Of small values mostly, or of any: zeros and small distances are what COBS makes most of.
inline link::Payload random_payload(Random& random) {
  link::Payload payload{};
  const uint32_t values = uint32_t{1} << random.below(9);
  for (uint8_t& byte : payload) byte = static_cast<uint8_t>(random.below(values));
  return payload;
}

inline link::MessageType random_type(Random& random) {
  return static_cast<link::MessageType>(1 + random.below(8));
}

inline Bytes random_frame(Random& random, link::FrameWriter& writer) {
  const link::MessageType type = random_type(random);
  return written(writer, type, random_payload(random));
}

}  // namespace palpate::test
