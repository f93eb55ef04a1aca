// The worst of many within a budget, with no sorting: count them by class, find the class down to which the
// budget reaches, take all above it, and of that class what still fits. No step has a branch that depends on
// what is looked at.
#pragma once

#include "palpate/numeric/all_of.hpp"
#include "palpate/numeric/bounded.hpp"
#include "palpate/numeric/reciprocal.hpp"

namespace palpate {

inline constexpr uint32_t kClasses = 64;

/// Two classes an octave: neighbours differ by less than half. 0 for 0 and 1.
constexpr uint32_t class_of(uint32_t measure) {
  const auto zeros = static_cast<uint32_t>(leading_zeros(measure | 1u));
  return 2 * (31 - zeros) + ((measure << zeros >> 30) & 1u);
}

/// Where something stands that has no place among the worst, below all classes; they are counted from 1.
using Rank = uint8_t;
inline constexpr Rank kUnwanted = 0;
constexpr Rank rank_of(uint32_t measure, bool is_wanted) {
  return static_cast<Rank>((1 + class_of(measure)) * (is_wanted ? 1u : 0u));
}

class RankCounts {
 public:
  RankCounts() {
    for (const uint32_t i : bounded<kRanks>(kRanks, [] {})) counts_[i] = 0;
  }
  void add(Rank rank) { ++counts_[rank]; }
  /// Of all that are wanted.
  [[nodiscard]] uint32_t total() const {
    uint32_t sum = 0;
    for (const uint32_t i : bounded<kClasses>(kClasses, [] {})) sum += counts_[1 + i];
    return sum;
  }
  /// The lowest of which some fit into the budget, and how many; without a budget none of the highest that
  /// there is.
  struct Lowest {
    uint32_t rank, room;
  };
  [[nodiscard]] Lowest lowest_within(uint32_t budget) const {
    uint32_t sum = 0;
    Lowest lowest{kClasses, 0};
    for (const uint32_t i : bounded<kClasses>(kClasses, [] {})) {
      const uint32_t rank = kClasses - i;
      lowest = sum < budget || sum == 0 ? Lowest{rank, budget - sum} : lowest;
      sum += counts_[rank];
    }
    return lowest;
  }

 private:
  static constexpr uint32_t kRanks = kClasses + 1;
  std::array<uint32_t, kRanks> counts_;
};

}  // namespace palpate
