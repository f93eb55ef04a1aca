#include "paper/smoothness.hpp"

#include <algorithm>

#include "output/projection.hpp"

namespace palpate::sim {
namespace {

using Forces = std::vector<std::array<double, 3>>;

constexpr double kMilli = 1e3;

double step_mn(const Forces& force_n, std::size_t k) {
  return kMilli * length(minus(force_n[k], force_n[k - 1]));
}

}  // namespace

Smoothness smoothness_of(const Forces& force_n, uint32_t from_tick) {
  Smoothness worst;
  for (std::size_t k = from_tick + 1; k < force_n.size(); ++k) {
    worst.step_mn = std::max(worst.step_mn, step_mn(force_n, k));
    if (k < from_tick + 2) continue;
    const Point3 change = minus(minus(force_n[k], force_n[k - 1]), minus(force_n[k - 1], force_n[k - 2]));
    worst.second_difference_mn = std::max(worst.second_difference_mn, kMilli * length(change));
  }
  return worst;
}

ChartPoints steps_over_time(const Forces& force_n, uint32_t window) {
  ChartPoints points;
  for (std::size_t start = 1; start < force_n.size(); start += window) {
    const std::size_t end = std::min(force_n.size(), start + window);
    double largest = 0.0;
    for (std::size_t k = start; k < end; ++k) largest = std::max(largest, step_mn(force_n, k));
    points.push_back({static_cast<double>(start) * 1e-3, largest});
  }
  return points;
}

ChartPoints magnitude_over_time(const Forces& force_n, uint32_t every) {
  ChartPoints points;
  for (std::size_t k = 0; k < force_n.size(); k += every) {
    points.push_back({static_cast<double>(k + 1) * 1e-3, kMilli * length(force_n[k])});
  }
  return points;
}

}  // namespace palpate::sim
