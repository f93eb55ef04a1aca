// Thresholds of a criterion that spread its meshes evenly from hardly refined to half of the finest one.
#pragma once

#include "paper/criterion_study.hpp"

namespace palpate::sim {

/// A threshold whose mesh tells most of a curve: in the middle, in logarithms, of those two neighbours whose
/// meshes are farthest apart in tets. 0 when all are near each other, in tets (kNearTets) or within 3 % in
/// threshold, or have more than `most_tets` on both sides. Points are sorted, the coarsest threshold first.
double next_threshold(const std::vector<StudyPoint>& points, double most_tets);

}  // namespace palpate::sim
