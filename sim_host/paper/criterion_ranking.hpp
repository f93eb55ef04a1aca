// Which criterion is the best by what was measured. No criterion wins everywhere, so a rule, and not one
// load, chooses the default: the lowest geometric mean, over all loads, of the error at equal numbers of
// tets; criteria within 5 % of it are equally good, and of those the one that takes the least time is chosen.
#pragma once

#include "paper/criterion_study.hpp"

namespace palpate::sim {

struct RankedError {
  double mm;
  std::string name;
  double remesh_ns;  // mean over its points; 0 of a uniform mesh
};

/// Of one load: the geometric mean of error_at over the range of tets that the criteria share, the best
/// first.
struct Ranking {
  double least_tets, most_tets;
  std::vector<RankedError> order;
};
Ranking rank(const LoadStudy& study);

/// Geometric means of the errors over all loads, the best first, and mean times.
std::vector<RankedError> rank_all(const std::vector<LoadStudy>& studies);

/// The one with this name; there must be one.
const RankedError& error_of(const std::vector<RankedError>& order, const std::string& name);
/// The first one that is not the uniform mesh; there must be one.
const RankedError& best_criterion(const std::vector<RankedError>& order);

/// By the rule above.
const RankedError& chosen_criterion(const std::vector<RankedError>& means);

/// What a scenario refines by that says nothing of it.
std::string default_criterion();

/// "bend to level 6".
std::string name_of(const LoadStudy& study);

/// One paragraph: which criterion the rule chooses, whether it is the default, and for which loads another
/// one or a uniform mesh is better.
std::string conclusion_of(const std::vector<LoadStudy>& studies);

}  // namespace palpate::sim
