// Port: the three joint encoders.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::port {

/// Counts of the three encoders since the board's reset, in the device's joint order. The board extends
/// narrow hardware counters to 32 bits; it neither scales nor changes signs.
///
/// Called by: the cycle, once a tick, before everything else.
/// Bounded by: straight-line code, at most 6 device-register accesses (a latch and a count for each axis).
/// Never waits: a decoder that has nothing new gives its last count.
std::array<int32_t, 3> read_encoders();

/// Number of the reading that read_encoders gave last, modulo 2^32: it goes up by one with each reading that
/// the decoders delivered, so a device that has fallen silent shows.
///
/// Called by: the cycle, once a tick, after read_encoders. Bounded by: no device-register access.
uint32_t encoder_reading_number();

}  // namespace palpate::port
