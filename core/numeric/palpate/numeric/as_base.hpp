// Arrays of which a hot loop takes elements by an index of its own.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate {

/// A pointer that the compiler takes as it comes, in a register of its own, so that an element is one
/// instruction. Else it computes the address from that of the object around the array, for each element anew.
template <class T>
PALPATE_ALWAYS_INLINE T* as_base(T* array) {
#ifdef PALPATE_TARGET
  asm("" : "+r"(array));
#endif
  return array;
}

}  // namespace palpate
