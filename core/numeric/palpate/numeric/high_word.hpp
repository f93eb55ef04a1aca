// Products whose high word is the answer: with formats chosen so that F1 + F2 - 32 fraction bits are wanted,
// a Cortex-M multiplies, rounds to nearest (ties up) and adds in one instruction. Elsewhere the same bits.
#pragma once

#include "palpate/numeric/q.hpp"

namespace palpate {

/// a b, as narrow<To>(a * b).
template <class To, int I1, int F1, int I2, int F2>
PALPATE_ALWAYS_INLINE To multiply_high(Q<I1, F1> a, Q<I2, F2> b) {
  static_assert(F1 + F2 - 32 == To::kFractionBits,
                "palpate: the high word of this product has another format");
#ifdef PALPATE_TARGET
  int32_t high;
  asm("smmulr %0, %1, %2" : "=r"(high) : "r"(a.raw()), "r"(b.raw()));
  return To::from_raw(high);
#else
  return narrow<To>(a * b);
#endif
}

/// sum + a b, rounded once.
template <class To, int I1, int F1, int I2, int F2>
PALPATE_ALWAYS_INLINE To multiply_add_high(Q<I1, F1> a, Q<I2, F2> b, To sum) {
  static_assert(F1 + F2 - 32 == To::kFractionBits,
                "palpate: the high word of this product has another format");
#ifdef PALPATE_TARGET
  int32_t high;
  asm("smmlar %0, %1, %2, %3" : "=r"(high) : "r"(a.raw()), "r"(b.raw()), "r"(sum.raw()));
  return To::from_raw(high);
#else
  return narrow<To>(widen<F1 + F2>(sum) + a * b);
#endif
}

}  // namespace palpate
