// Which measure of stretch refines a mesh best: the errors of the meshes it ends with over the number of
// tets, for three loads.
#pragma once

#include "paper/experiment.hpp"
#include "paper/mesh_error.hpp"

namespace palpate::sim {

inline constexpr const char* kUniformMesh = "uniform mesh";
/// Meshes this factor apart in tets are near each other.
inline constexpr double kNearTets = 1.5;

struct StudyPoint {
  double threshold;  // 0 for a uniform mesh
  double tets;       // at rest
  MeshError error;   // of the equilibrium on that mesh, from the one on the uniform mesh of the finest level
  double force_percent;       // of the force on the driven node, the same; 0 where none is driven
  double off_mm;              // how far the run was from its own equilibrium in the end, mean
  double remesh_ns, tick_ns;  // of the host a tick and tet, in the re-mesh stage and in all; 0 if uniform
  std::string command;        // empty for a uniform mesh
};

struct StudyCurve {
  std::string criterion;  // "six-edges", or "uniform mesh"
  std::vector<StudyPoint> points;
};

struct LoadStudy {
  std::string load;  // "bend"
  int finest_level;
  bool has_force;  // a node is driven
  std::vector<StudyCurve> curves;
};

/// What is compared: where the body is, and what the hand feels.
enum class StudyError { kMeanMm, kForcePercent };

/// Loads bend, corner and indentation with the finest level 6, then the same with 9. A run gives the mesh;
/// its error is that of the equilibrium on it, so that a run need not have come to rest completely.
std::vector<LoadStudy> study_criteria(const Experiment& experiment);

/// The error that a curve has at a number of tets, on straight lines between its points in logarithms;
/// infinite below its first point, that of its last point above, and that of the point before where the next
/// one is not near it (kNearTets). Never below 1 um or 1 %: what is below is equally good.
double error_at(const StudyCurve& curve, double tets, StudyError which);

}  // namespace palpate::sim
