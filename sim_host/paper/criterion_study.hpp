// Which measure of stretch refines a mesh best: the error of the
// meshes it ends with over the number of tets, for three loads.
#pragma once

#include "paper/experiment.hpp"
#include "paper/mesh_error.hpp"

namespace palpate::sim {

inline constexpr const char* kUniformMesh = "uniform mesh";

struct StudyPoint {
  double threshold;  // 0 for a uniform mesh
  double mean_tets;  // over the run
  uint32_t tets;     // at its end
  MeshError error;   // of the equilibrium on that mesh, from the one on the uniform mesh of the finest level
  double off_mm;     // how far the run was from its own equilibrium in the end, mean
  double remesh_ns;  // of the host in the re-mesh stage, a tick and tet
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

/// Loads bend, corner and indentation with the finest level 6, then the same with 9. A run gives the mesh;
/// its error is that of the equilibrium on it, so that a run need not have come to rest completely.
std::vector<LoadStudy> study_criteria(const Experiment& experiment);

/// The mean error, mm, that a curve has at a mean number of tets, on straight lines between its points in
/// logarithms; infinite below its first point, that of its last point above, and that of the point before
/// where the next one has over three times its tets. Never below 1 um: what is below is equally good.
double error_at(const StudyCurve& curve, double tets);

}  // namespace palpate::sim
