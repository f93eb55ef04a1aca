// Which measure of stretch refines a mesh best: error at rest over the number of tets, for three loads.
#pragma once

#include "paper/experiment.hpp"
#include "paper/mesh_error.hpp"

namespace palpate::sim {

struct StudyPoint {
  double threshold;  // 0 for a uniform mesh
  double mean_tets;  // over the run
  uint32_t tets;     // at its end
  MeshError error;   // at rest, from the uniform mesh of the finest level
  bool is_at_rest;
  std::string command;  // empty for a uniform mesh
};

struct StudyCurve {
  std::string criterion;  // "six-edges", or "uniform mesh"
  std::vector<StudyPoint> points;
};

struct LoadStudy {
  std::string load;  // "bend"
  int finest_level;
  std::vector<StudyCurve> curves;
};

/// Loads bend, corner and indentation with the finest level 6, then the same with 9.
std::vector<LoadStudy> study_criteria(const Experiment& experiment);

/// The mean error, mm, that a curve has at a mean number of tets, on straight lines between its points in
/// logarithms; infinite below its first point, that of its last point above.
double error_at(const StudyCurve& curve, double tets);

}  // namespace palpate::sim
