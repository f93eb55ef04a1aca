// Buttons without the bouncing of their contacts, over ticks, without waiting in any.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::device {

/// 32 buttons side by side. A bit of the answer changes when four readings in a row say so.
class Debounce {
 public:
  /// One reading a tick. Straight-line code.
  constexpr uint32_t take(uint32_t reading) {
    const uint32_t differs = reading ^ stable_;
    high_ = (high_ ^ low_) & differs;
    low_ = ~low_ & differs;
    stable_ ^= differs & ~(high_ | low_);
    return stable_;
  }

 private:
  uint32_t stable_ = 0;
  uint32_t low_ = 0;  // how many readings in a row differ, modulo 4: a bit of each count in either word
  uint32_t high_ = 0;
};

namespace debounce_detail {

/// What is stable after these readings of one button.
constexpr uint32_t after(std::array<uint32_t, 8> readings) {
  Debounce button;
  uint32_t stable = 0;
  for (const uint32_t reading : readings) stable = button.take(reading);
  return stable;
}

static_assert(after({0, 0, 0, 0, 0, 1, 1, 1}) == 0, "three readings are not enough");
static_assert(after({0, 0, 0, 0, 1, 1, 1, 1}) == 1, "four are");
static_assert(after({0, 1, 1, 1, 0, 1, 1, 1}) == 0, "they have to follow each other");
static_assert(after({1, 1, 1, 1, 0, 0, 0, 1}) == 1, "a release takes as long");
static_assert(after({1, 1, 1, 1, 0, 0, 0, 0}) == 0);

}  // namespace debounce_detail
}  // namespace palpate::device
