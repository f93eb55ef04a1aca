// Clamps to powers of two, and whether one of them changed anything. On a Cortex-M a clamp is one
// instruction, whose sticky flag remembers at no cost: there is one flag only, so of two ClampFlags the lives
// must not overlap. Elsewhere the same bits.
#pragma once

#include "palpate/numeric/q.hpp"

namespace palpate {

/// Within -2^(Bits - 1) .. 2^(Bits - 1) - 1. It sets the sticky flag: not while a ClampFlag is in use.
template <int Bits>
PALPATE_ALWAYS_INLINE int32_t within_bits(int32_t value) {
  static_assert(Bits >= 1 && Bits < 32, "palpate: a clamp keeps 1 to 31 bits");
#ifdef PALPATE_TARGET
  int32_t within;
  asm("ssat %0, %1, %2" : "=r"(within) : "I"(Bits), "r"(value));
  return within;
#else
  constexpr int32_t kMost = (int32_t{1} << (Bits - 1)) - 1;
  return value > kMost ? kMost : value < -kMost - 1 ? -kMost - 1 : value;
#endif
}

class ClampFlag {
 public:
  PALPATE_ALWAYS_INLINE ClampFlag() { forget(); }

  /// Within -2^(Bits - 1) .. 2^(Bits - 1) - 1 raw.
  template <int Bits, class Fixed>
  PALPATE_ALWAYS_INLINE Fixed clamp(Fixed value) {
    static_assert(Bits >= 1 && Bits < 32, "palpate: a clamp keeps 1 to 31 bits");
#ifdef PALPATE_TARGET
    int32_t within;
    asm volatile("ssat %0, %1, %2" : "=r"(within) : "I"(Bits), "r"(value.raw()));
#else
    const int32_t within = within_bits<Bits>(value.raw());
    is_set_ = is_set_ || within != value.raw();
#endif
    return Fixed::from_raw(within);
  }

  /// Whether something was clamped since the last time.
  [[nodiscard]] PALPATE_ALWAYS_INLINE bool take() {
#ifdef PALPATE_TARGET
    uint32_t flags;
    asm volatile("mrs %0, apsr" : "=r"(flags));
    forget();
    constexpr uint32_t kSticky = 1u << 27;
    return (flags & kSticky) != 0;
#else
    const bool was_set = is_set_;
    forget();
    return was_set;
#endif
  }

 private:
  PALPATE_ALWAYS_INLINE void forget() {
#ifdef PALPATE_TARGET
    asm volatile("msr apsr_nzcvq, %0" : : "r"(0) : "cc");
#else
    is_set_ = false;
#endif
  }

#ifndef PALPATE_TARGET
  bool is_set_;
#endif
};

}  // namespace palpate
