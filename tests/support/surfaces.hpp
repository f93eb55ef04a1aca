// The surface of a body in doubles, found independently of core/touch: a tet's face that no other tet has.
#pragma once

#include <Eigen/Dense>

#include <set>

#include "support/fixed.hpp"
#include "support/forests.hpp"
#include "support/random.hpp"

namespace palpate::test {

struct Face {
  std::array<uint16_t, 3> node;
  std::array<Eigen::Vector3d, 3> x;  // counterclockwise from outside at rest
  Eigen::Vector3d opposite;          // the tet's fourth vertex
};

template <class Profile>
std::vector<Face> faces_of(const Forest<Profile>& forest) {
  std::map<std::set<uint16_t>, std::pair<int, std::array<uint16_t, 4>>> seen;
  for (uint32_t i = 0; i < forest.leaf_count; ++i) {
    const auto& node = forest.leaf[i].node;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::array<uint16_t, 4> own = {node[(k + 1) % 4], node[(k + 2) % 4], node[(k + 3) % 4], node[k]};
      auto& entry = seen[{own[0], own[1], own[2]}];
      ++entry.first;
      entry.second = own;
    }
  }
  std::vector<Face> faces;
  for (const auto& [nodes, entry] : seen) {
    if (entry.first != 1) continue;
    auto own = entry.second;
    const auto rest = [&](std::size_t k) { return doubles(rest_position(forest.node.rest[own[k]])); };
    const double side = (rest(1) - rest(0)).cross(rest(2) - rest(0)).dot(rest(0) - rest(3));
    if (side < 0.0) std::swap(own[1], own[2]);
    const auto at = [&](std::size_t k) { return doubles(forest.node.position[own[k]]); };
    faces.push_back({{own[0], own[1], own[2]}, {at(0), at(1), at(2)}, at(3)});
  }
  return faces;
}

inline double distance_to_segment(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                  const Eigen::Vector3d& p) {
  const Eigen::Vector3d d = b - a;
  const double square = d.squaredNorm();
  const double t = square > 0.0 ? std::clamp((p - a).dot(d) / square, 0.0, 1.0) : 0.0;
  return (p - (a + t * d)).norm();
}

/// By half planes in the triangle's own plane, and the three edges.
inline double distance_to_triangle(const std::array<Eigen::Vector3d, 3>& x, const Eigen::Vector3d& p) {
  const double least = std::min({distance_to_segment(x[0], x[1], p), distance_to_segment(x[1], x[2], p),
                                 distance_to_segment(x[2], x[0], p)});
  const Eigen::Vector3d normal = (x[1] - x[0]).cross(x[2] - x[0]);
  if (normal.norm() == 0.0) return least;
  const Eigen::Vector3d n = normal.normalized();
  bool inside = true;
  for (std::size_t i = 0; i < 3; ++i) {
    inside = inside && n.cross(x[(i + 1) % 3] - x[i]).dot(p - x[i]) >= 0.0;
  }
  return inside ? std::abs(n.dot(p - x[0])) : least;
}

inline double distance_to(const std::vector<Face>& faces, const Eigen::Vector3d& p) {
  double least = 1e9;
  for (const Face& face : faces) least = std::min(least, distance_to_triangle(face.x, p));
  return least;
}

/// How often the surface goes around p: 1 inside, 0 outside (solid angles, Van Oosterom and Strackee 1983).
inline double winding_number(const std::vector<Face>& faces, const Eigen::Vector3d& p) {
  double sum = 0.0;
  for (const Face& face : faces) {
    const Eigen::Vector3d a = face.x[0] - p;
    const Eigen::Vector3d b = face.x[1] - p;
    const Eigen::Vector3d c = face.x[2] - p;
    const double volume = a.dot(b.cross(c));
    const double scale =
        a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() + b.dot(c) * a.norm() + c.dot(a) * b.norm();
    sum += 2.0 * std::atan2(volume, scale);
  }
  return sum / (4.0 * 3.14159265358979323846);
}

/// The notched block at rest, with so many patches split at random and some merged again.
template <class Profile>
std::unique_ptr<Forest<Profile>> changed_forest(Random& random, int changes) {
  auto forest = roots_of<Profile>(notched_block());
  for (int i = 0; i < changes; ++i) {
    const uint16_t tet = forest->leaf[random.below(forest->leaf_count)].tet;
    Patch patch{};
    if (random.below(4) == 0) {
      if (find_merge(*forest, tet, patch) == MeshStatus::kDone) merge(*forest, patch);
    } else {
      bisect_with_closure(*forest, tet);
    }
  }
  return forest;
}

/// Bent smoothly, without turning a tet inside out.
template <class Profile>
void deform_smoothly(Forest<Profile>& forest, Random& random, double strength) {
  const Eigen::Vector3d wave = 2.0 * random.vector();
  const Eigen::Vector3d amplitude = 0.5 * strength * random.vector();
  const Eigen::Matrix3d stretch = Eigen::Matrix3d::Identity() + 0.3 * strength * random.matrix();
  for (uint32_t i = 0; i < forest.nodes.used(); ++i) {
    const uint16_t node = forest.nodes.live(i);
    const Eigen::Vector3d x0 = doubles(rest_position(forest.node.rest[node]));
    forest.node.position[node] =
        fixed_vector<Position>(Eigen::Vector3d(stretch * x0 + amplitude * std::sin(wave.dot(x0))));
  }
}

}  // namespace palpate::test
