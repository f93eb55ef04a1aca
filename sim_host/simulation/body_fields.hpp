// A body's mesh and what is known at its nodes and tets, in plain arrays: what any body, of the core in any
// profile or of the double-precision reference, shows to a viewer.
#pragma once

// Sets Eigen up for the headers below.
#include "palpate/numeric/platform.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace palpate::sim {

struct BodyFields {
  // A value a node.
  std::vector<std::array<double, 3>> rest_mm;
  std::vector<std::array<double, 3>> now_mm;
  std::vector<std::array<double, 3>> velocity_mm_s;
  std::vector<std::array<double, 3>> force_n;  // elastic

  // A value a tet. Nodes in VTK's order: positive volume at rest.
  std::vector<std::array<uint32_t, 4>> tets;
  std::vector<int32_t> level;
  std::vector<int32_t> region;
  std::vector<int32_t> rotation_tet;  // tets with the same number use the same rotation
  std::vector<double> volume_ratio;   // det F: now over rest
  std::vector<double> von_mises_pa;
};

/// sqrt(3/2) |dev sigma|.
inline double von_mises(const Eigen::Matrix3d& sigma) {
  const Eigen::Matrix3d deviator = sigma - sigma.trace() / 3.0 * Eigen::Matrix3d::Identity();
  return std::sqrt(1.5) * deviator.norm();
}

/// The same nodes, the last two exchanged if that makes the volume positive.
inline std::array<uint32_t, 4> oriented(const std::array<uint32_t, 4>& tet,
                                        const std::vector<std::array<double, 3>>& at) {
  const auto point = [&](std::size_t i) { return Eigen::Vector3d(at[tet[i]].data()); };
  const Eigen::Vector3d a = point(1) - point(0);
  const Eigen::Vector3d b = point(2) - point(0);
  if (a.cross(b).dot(point(3) - point(0)) > 0.0) return tet;
  return {tet[0], tet[1], tet[3], tet[2]};
}

}  // namespace palpate::sim
