// Which criterion is the best by what was measured. A controller is short of two things, room for tets and
// time, and no criterion wins everywhere, so a rule chooses. The error of a criterion is the geometric mean,
// over all loads, of its errors of displacement and of force: at equal numbers of tets, and at equal times of
// a tick. Its loss is how far it is behind the best, where it is farther. The least loss is the best; a
// default within 5 % of it stays.
#pragma once

#include "paper/criterion_study.hpp"

namespace palpate::sim {

/// What is equal when errors are compared.
enum class Equal { kTets, kTime };

struct RankedError {
  double error;  // mm, percent of the force, or part of the uniform mesh's
  std::string name;
};

/// The best first, from one amount to another: tets, or ns a tick.
struct Ranking {
  double least, most;
  std::vector<RankedError> order;
};

/// Of one load and one error: the geometric mean over the range that the criteria share. It ends where the
/// uniform mesh has half of the finest one's tets: beyond, all criteria come to be that mesh.
Ranking rank(const LoadStudy& study, StudyError which, Equal equal);

/// Geometric means over all loads and both errors, as parts of the uniform mesh's.
std::vector<RankedError> rank_all(const std::vector<LoadStudy>& studies, Equal equal);

/// Criteria and their losses, 1 being none, the least first.
std::vector<RankedError> losses_of(const std::vector<LoadStudy>& studies);

/// Mean time of the re-mesh stage a tick and tet.
double remesh_ns_of(const std::vector<LoadStudy>& studies, const std::string& criterion);

/// Displacements always, forces where a node is driven.
std::vector<StudyError> errors_of(const LoadStudy& study);

/// The one with this name; there must be one.
const RankedError& error_of(const std::vector<RankedError>& order, const std::string& name);
/// The first one that is not the uniform mesh; there must be one.
const RankedError& best_criterion(const std::vector<RankedError>& order);

/// What a scenario refines by that says nothing of it.
std::string default_criterion();

/// "bend to level 6, mm".
std::string name_of(const LoadStudy& study, StudyError which);

/// One paragraph: losses, whether the default stays, and for which loads a uniform mesh is better.
std::string conclusion_of(const std::vector<LoadStudy>& studies);

}  // namespace palpate::sim
