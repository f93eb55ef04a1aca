// Consistent overhead byte stuffing (Cheshire and Baker, IEEE/ACM Transactions on Networking 7(2), 1999):
// bytes are encoded without the value 0, which is then free to end a frame. A byte that is 0 becomes the
// distance to the next one; the first distance stands before all bytes, the last one points behind them.
//
//   11 00 00 22 33   ->   02 11 01 03 22 33
//
// One byte longer, always, for less than 254 bytes. Longer frames would need more codes and are refused.
#pragma once

#include "palpate/numeric/bounded.hpp"

namespace palpate::link {

/// Byte i goes to place i + 1. One pass.
template <std::size_t Size>
void cobs_encode(const std::array<uint8_t, Size>& plain, std::array<uint8_t, Size + 1>& encoded) {
  static_assert(Size < 254, "palpate: COBS of 254 bytes and more needs further code bytes");
  std::size_t code = 0;  // the place of the distance that is still open
  for (const uint32_t i : bounded<Size>(Size, [] {})) {
    if (plain[i] != 0) {
      encoded[i + 1] = plain[i];
    } else {
      encoded[code] = static_cast<uint8_t>(i + 1 - code);
      code = i + 1;
    }
  }
  encoded[code] = static_cast<uint8_t>(Size + 1 - code);
}

enum class CobsEvent : uint8_t {
  kNone,  ///< nothing to take yet
  kByte,  ///< byte() is the next decoded one
  kEnd,   ///< a 0 came where the last distance pointed: what was decoded is whole
  kCut    ///< a 0 came before: discard what was decoded
};

/// A byte at a time, without a buffer. Whatever came before, it is in step again after each 0. Zeros in a row
/// are kNone. It knows no lengths: its user counts what it gets.
class CobsDecoder {
 public:
  /// Straight-line code.
  [[nodiscard]] constexpr CobsEvent push(uint8_t encoded) {
    if (encoded == 0) {
      const CobsEvent event = is_fresh_ ? CobsEvent::kNone : left_ == 0 ? CobsEvent::kEnd : CobsEvent::kCut;
      *this = CobsDecoder();
      return event;
    }
    if (left_ == 0) {
      const bool stands_for_zero = !is_fresh_;
      is_fresh_ = false;
      left_ = static_cast<uint8_t>(encoded - 1);
      byte_ = 0;
      return stands_for_zero ? CobsEvent::kByte : CobsEvent::kNone;
    }
    --left_;
    byte_ = encoded;
    return CobsEvent::kByte;
  }
  [[nodiscard]] constexpr uint8_t byte() const { return byte_; }

 private:
  uint8_t left_ = 0;  // bytes until the next distance
  uint8_t byte_ = 0;
  bool is_fresh_ = true;  // nothing has come since the last 0
};

}  // namespace palpate::link
