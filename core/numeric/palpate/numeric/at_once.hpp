// Orders for the compiler, which cost no instruction, in loops that take two of a kind at once: a load may
// have to wait for a store before it, so all is loaded before any is stored, and numbers that the loop keeps
// in registers are few.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate {

/// What follows has both, or none yet.
PALPATE_ALWAYS_INLINE void have_both(uint32_t& a, uint32_t& b) {
#ifdef PALPATE_TARGET
  asm("" : "+r"(a), "+r"(b));
#else
  static_cast<void>(a);
  static_cast<void>(b);
#endif
}

/// What follows is computed from this value, not from what it is made of.
template <class Fixed>
PALPATE_ALWAYS_INLINE void take_as_it_is(Fixed& value) {
#ifdef PALPATE_TARGET
  int32_t raw = value.raw();
  asm("" : "+r"(raw));
  value = Fixed::from_raw(raw);
#else
  static_cast<void>(value);
#endif
}

}  // namespace palpate
