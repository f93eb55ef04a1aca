// The worst of many within a budget, with no sorting: count them by class, find the class down to which the
// budget reaches, take all above it, then of that class what still fits.
#pragma once

#include "palpate/numeric/bounded.hpp"
#include "palpate/numeric/reciprocal.hpp"

namespace palpate {

inline constexpr uint32_t kClasses = 64;

/// Two classes an octave: neighbours differ by less than half. 0 for 0.
constexpr uint32_t class_of(uint32_t measure) {
  if (measure < 2) return measure;
  const auto exponent = static_cast<uint32_t>(31 - leading_zeros(measure));
  return 2 * exponent + ((measure >> (exponent - 1)) & 1u);
}

class ClassCounts {
 public:
  ClassCounts() {
    for (const uint32_t i : bounded<kClasses>(kClasses, [] {})) counts_[i] = 0;
  }
  void add(uint32_t which) { ++counts_[which]; }
  [[nodiscard]] uint32_t total() const {
    uint32_t sum = 0;
    for (const uint32_t i : bounded<kClasses>(kClasses, [] {})) sum += counts_[i];
    return sum;
  }
  /// The lowest class so that all above it fit into the budget; without a budget the highest that has any.
  [[nodiscard]] uint32_t lowest_within(uint32_t budget) const {
    uint32_t sum = 0;
    uint32_t lowest = 0;
    for (const uint32_t i : bounded<kClasses>(kClasses, [] {})) {
      const uint32_t which = kClasses - 1 - i;
      if (sum < budget || sum == 0) lowest = which;
      sum += counts_[which];
    }
    return lowest;
  }

 private:
  std::array<uint16_t, kClasses> counts_;
};

}  // namespace palpate
