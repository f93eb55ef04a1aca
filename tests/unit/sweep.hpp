// Sweeps over raw 32-bit inputs: strided in the tests, every input when PALPATE_SOAK is 1 in the environment.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace palpate::test {

inline bool soaking() {
  const char* soak = std::getenv("PALPATE_SOAK");
  return soak != nullptr && std::strcmp(soak, "1") == 0;
}

/// visit(raw) for first, last and every stride-th between them.
template <class Visit>
void sweep(int64_t first, int64_t last, int64_t stride, Visit visit) {
  const int64_t step = soaking() ? 1 : stride;
  for (int64_t raw = first; raw < last; raw += step) visit(static_cast<int32_t>(raw));
  visit(static_cast<int32_t>(last));
}

/// Remembers the largest absolute error, and where.
struct WorstError {
  double error = 0;
  int64_t at = 0;
  void see(double difference, int64_t input) {
    if (!(std::fabs(difference) <= error)) {
      error = std::fabs(difference);
      at = input;
    }
  }
};

template <class Fixed>
double to_double(Fixed value) {
  return std::ldexp(static_cast<double>(value.raw()), -Fixed::kFractionBits);
}

}  // namespace palpate::test
