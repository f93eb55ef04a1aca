// CRC-32C (Castagnoli): polynomial 0x1EDC6F41, bits reflected, start and final value 0xFFFFFFFF. Of the ASCII
// text "123456789" it is 0xE3069283 (RFC 3720 has more). It finds every burst of up to 32 bits, up to 5 wrong
// bits anywhere in up to 655 bytes, and up to 3 in any chunk (P. Koopman, "32-Bit Cyclic Redundancy Codes for
// Internet Applications", DSN 2002).
#pragma once

#include "palpate/container/bytes.hpp"
#include "palpate/numeric/bounded.hpp"

namespace palpate::container {

namespace crc_detail {

/// Of four bits each, so that the table costs 64 bytes of flash and not a kilobyte.
constexpr std::array<uint32_t, 16> make_table() {
  constexpr uint32_t kReflected = 0x82f63b78u;
  std::array<uint32_t, 16> table{};
  for (uint32_t nibble = 0; nibble < 16; ++nibble) {
    uint32_t rest = nibble;
    for (int bit = 0; bit < 4; ++bit) rest = (rest >> 1) ^ ((rest & 1u) != 0 ? kReflected : 0u);
    table[nibble] = rest;
  }
  return table;
}
inline constexpr std::array<uint32_t, 16> kTable = make_table();

}  // namespace crc_detail

class Crc32c {
 public:
  /// In one call.
  static constexpr uint32_t kMostBytes = (1u << 20) + 32u;

  /// O(size), two table look-ups a byte.
  void add(Bytes bytes) {
    for (const uint32_t i : bounded<kMostBytes>(bytes.size, [] {})) {
      rest_ ^= bytes.data[i];
      rest_ = (rest_ >> 4) ^ crc_detail::kTable[rest_ & 15u];
      rest_ = (rest_ >> 4) ^ crc_detail::kTable[rest_ & 15u];
    }
  }
  void add_u32(uint32_t word) {
    uint8_t bytes[4]{};
    put_u32(bytes, word);
    add(Bytes{bytes, 4});
  }
  [[nodiscard]] uint32_t value() const { return ~rest_; }

 private:
  uint32_t rest_ = ~0u;
};

inline uint32_t crc32c(Bytes bytes) {
  Crc32c crc;
  crc.add(bytes);
  return crc.value();
}

}  // namespace palpate::container
