#include "contest.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace palpate::bench {
namespace {

double processor_us() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

/// Between the nearest two.
double quantile(const std::vector<double>& sorted, double part) {
  const double place = part * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(std::floor(place));
  const auto above = static_cast<std::size_t>(std::ceil(place));
  return sorted[below] + (sorted[above] - sorted[below]) * (place - std::floor(place));
}

}  // namespace

Figure figure_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return Figure{quantile(values, 0.5), quantile(values, 0.25), quantile(values, 0.75)};
}

std::size_t Contest::add(std::function<void()> run, uint32_t times_a_slice) {
  contenders_.push_back({std::move(run), times_a_slice, {}});
  return contenders_.size() - 1;
}

void Contest::race(uint32_t rounds) {
  const auto slice_us = [](const Contender& contender) {
    const double start = processor_us();
    for (uint32_t i = 0; i < contender.times_a_slice; ++i) contender.run();
    return processor_us() - start;
  };
  for (const Contender& contender : contenders_) slice_us(contender);
  for (uint32_t round = 0; round < rounds; ++round) {
    for (Contender& contender : contenders_) {
      contender.us.push_back(slice_us(contender) / contender.times_a_slice);
    }
  }
}

Figure Contest::time_us(std::size_t contender) const { return figure_of(contenders_.at(contender).us); }

Figure Contest::speed_ratio(std::size_t contender, std::size_t slower) const {
  const std::vector<double>& us = contenders_.at(contender).us;
  const std::vector<double>& slower_us = contenders_.at(slower).us;
  std::vector<double> ratios;
  for (std::size_t round = 0; round < us.size(); ++round) ratios.push_back(slower_us[round] / us[round]);
  return figure_of(ratios);
}

}  // namespace palpate::bench
