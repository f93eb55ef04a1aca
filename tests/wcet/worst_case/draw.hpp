// Numbers of a seed: xorshift32 of Marsaglia, "Xorshift RNGs", 2003.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::worst_case {

class Draw {
 public:
  explicit Draw(uint32_t seed) : state_(seed * 2654435761u | 1u) {}
  uint32_t next() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 17;
    state_ ^= state_ << 5;
    return state_;
  }
  uint32_t below(uint32_t limit) { return next() % limit; }
  bool one_in(uint32_t count) { return below(count) == 0; }
  /// -limit .. limit
  int32_t within(int32_t limit) {
    return static_cast<int32_t>(below(2 * static_cast<uint32_t>(limit) + 1)) - limit;
  }

 private:
  uint32_t state_;
};

}  // namespace palpate::worst_case
