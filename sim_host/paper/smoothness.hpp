// How smooth a force is over the ticks of a run.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "output/chart.hpp"

namespace palpate::sim {

struct Smoothness {
  double step_mn = 0.0;               // largest |f(k) - f(k-1)|
  double second_difference_mn = 0.0;  // largest |f(k) - 2 f(k-1) + f(k-2)|
};

/// Over the ticks from `from_tick` on.
Smoothness smoothness_of(const std::vector<std::array<double, 3>>& force_n, uint32_t from_tick);

/// s, and the largest step per tick in mN of each window of so many ticks.
ChartPoints steps_over_time(const std::vector<std::array<double, 3>>& force_n, uint32_t window);

/// s, and |f| in mN, every so many ticks.
ChartPoints magnitude_over_time(const std::vector<std::array<double, 3>>& force_n, uint32_t every);

}  // namespace palpate::sim
