#include "paper/threshold_search.hpp"

#include <algorithm>
#include <cmath>

namespace palpate::sim {

double next_threshold(const std::vector<StudyPoint>& points, double most_tets) {
  constexpr double kNearThresholds = 1.03;
  double farthest = kNearTets;
  double next = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const StudyPoint& a = points[i - 1];
    const StudyPoint& b = points[i];
    const auto [least, most] = std::minmax(a.tets, b.tets);
    if (most <= farthest * least || a.threshold <= kNearThresholds * b.threshold || least > most_tets)
      continue;
    farthest = most / least;
    next = std::sqrt(a.threshold * b.threshold);
  }
  return next;
}

}  // namespace palpate::sim
