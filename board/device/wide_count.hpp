// Decoders with counters of 16 bits, extended to 32.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::device {

/// The count that is nearest to the last one among all whose low 16 bits are the counter's. Right as long as
/// an axis moves less than 32768 counts between two readings.
constexpr int32_t wide_count(int32_t last, uint32_t counter) {
  const auto moved = static_cast<uint16_t>(counter - static_cast<uint32_t>(last));
  return static_cast<int32_t>(static_cast<uint32_t>(last) +
                              static_cast<uint32_t>(int32_t{static_cast<int16_t>(moved)}));
}

static_assert(wide_count(0, 5) == 5 && wide_count(0, 0xFFFF) == -1);
static_assert(wide_count(0x7FFF, 0x8000) == 0x8000 && wide_count(0x8000, 0x7FFF) == 0x7FFF);
static_assert(wide_count(0xFFFF, 0x0001) == 0x10001 && wide_count(-0x10000, 0xFFFF) == -0x10001);

}  // namespace palpate::device
