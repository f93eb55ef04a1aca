#include "palpate/ports/system.hpp"
#include "startup.hpp"

namespace palpate::port {

uint32_t stack_peak_bytes() {
  const uint32_t* word = palpate_stack_low;
  while (word < palpate_stack_top && *word == cortex_m::kStackPattern) ++word;
  return static_cast<uint32_t>(palpate_stack_top - word) * sizeof(uint32_t);
}

}  // namespace palpate::port
