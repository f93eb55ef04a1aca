// The CRC of frames: state of 16 bits, polynomial 0x5935 (x^16 is implied), initial value 0xffff, high bit of
// a byte first, nothing reflected, no final exclusive-or. Of "123456789" it is 0x772b: CRC-16/M17 in the
// catalogues, 0xac9a in Koopman's notation.
//
// Why this one: over a frame's 248 bits (29 bytes and the CRC) any two codewords differ in at least 5 bits,
// so any 4 wrong bits are found. That holds up to 257 bits; no polynomial of 16 bits has 6 there, and the
// usual ones (0x1021, 0x8005) have 4.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::link {

/// The most bytes that the CRC may cover for a distance of 5: 257 bits with its own 16.
inline constexpr std::size_t kCrc16CoveredBytes = 30;

namespace crc16_detail {

/// What four bits that leave the register at its top give back: k x^16 modulo the polynomial.
inline constexpr std::array<uint16_t, 16> kStep{0x0000, 0x5935, 0xb26a, 0xeb5f, 0x3de1, 0x64d4,
                                                0x8f8b, 0xd6be, 0x7bc2, 0x22f7, 0xc9a8, 0x909d,
                                                0x4623, 0x1f16, 0xf449, 0xad7c};

}  // namespace crc16_detail

/// A byte at a time. The table is 32 bytes: a step of four bits at a time is small and quick enough.
class Crc16 {
 public:
  /// Two table steps.
  constexpr void add(uint8_t byte) {
    add_half(static_cast<uint32_t>(byte) >> 4);
    add_half(byte & 0xfu);
  }
  /// Of all bytes so far; of none, 0xffff.
  [[nodiscard]] constexpr uint16_t value() const { return value_; }

 private:
  constexpr void add_half(uint32_t bits) {
    const uint32_t leaving = (uint32_t{value_} >> 12) ^ bits;
    value_ = static_cast<uint16_t>((uint32_t{value_} << 4) ^ crc16_detail::kStep[leaving]);
  }

  uint16_t value_ = 0xffff;
};

}  // namespace palpate::link
