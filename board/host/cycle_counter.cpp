#include "palpate/ports/cycle_counter.hpp"

#include <chrono>

namespace palpate::port {

uint32_t read_cycle_counter() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return static_cast<uint32_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(now).count());
}

uint32_t cycles_per_second() { return 1'000'000'000; }

}  // namespace palpate::port
