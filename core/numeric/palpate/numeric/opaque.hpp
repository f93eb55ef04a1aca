// What a compiler may not know or move, at the cost of no instruction. It takes a core for one whose loads never
// wait for stores, and adds up addresses anew where one that is kept would do.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate {

/// The value, of which the compiler knows nothing: it is kept as it is, and not made of others again.
template <class Value>
PALPATE_ALWAYS_INLINE Value opaque(Value value) {
  asm("" : "+r"(value));
  return value;
}

/// What follows has both, or none yet.
PALPATE_ALWAYS_INLINE void have_both(uint32_t& a, uint32_t& b) { asm("" : "+r"(a), "+r"(b)); }

/// All that is loaded before this is loaded before anything behind it is stored.
PALPATE_ALWAYS_INLINE void end_of_loads() { asm volatile("" ::: "memory"); }

}  // namespace palpate
