// Bytes that a DMA channel writes round and round, for the background to take.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::device {

/// Where the background is in a ring whose writer nobody stops: when it comes a whole round too late, those
/// bytes are lost.
template <uint32_t Size>
class RingReader {
 public:
  static_assert((Size & (Size - 1)) == 0, "palpate: a ring's size is a power of two");

  /// The index of the next byte, or Size when the writer, who is about to write at `written`, has none.
  constexpr uint32_t next(uint32_t written) {
    if (((written ^ place_) & (Size - 1)) == 0) return Size;
    const uint32_t index = place_;
    place_ = (place_ + 1) & (Size - 1);
    return index;
  }

 private:
  uint32_t place_ = 0;
};

}  // namespace palpate::device
