// What a compiler may not know or move on a target, at the cost of no instruction. It takes a core for one
// whose loads never wait for stores, and adds up addresses anew where one that is kept would do.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate {

/// The value, of which the compiler knows nothing: it is kept as it is, and not made of others again.
template <class Value>
PALPATE_ALWAYS_INLINE Value opaque(Value value) {
#ifdef PALPATE_TARGET
  asm("" : "+r"(value));
#endif
  return value;
}

/// What follows has both, or none yet.
PALPATE_ALWAYS_INLINE void have_both([[maybe_unused]] uint32_t& a, [[maybe_unused]] uint32_t& b) {
#ifdef PALPATE_TARGET
  asm("" : "+r"(a), "+r"(b));
#endif
}

/// All that is loaded before this is loaded before anything behind it is stored.
PALPATE_ALWAYS_INLINE void end_of_loads() {
#ifdef PALPATE_TARGET
  asm volatile("" ::: "memory");
#endif
}

}  // namespace palpate
