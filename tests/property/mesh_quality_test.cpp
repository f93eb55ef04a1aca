// The shapes of a randomly refined mesh: three types only, with the quality that bisection promises.
#include <gtest/gtest.h>

#include "reference/mesh_from_forest.hpp"
#include "support/forests.hpp"
#include "support/random.hpp"

namespace palpate::test {
namespace {

struct Quality {
  double aspect_ratio;    // 3 x inradius / circumradius, 1 for the regular tet
  double radius_to_edge;  // circumradius / shortest edge
};

Quality quality_of(const std::array<Eigen::Vector3d, 4>& w) {
  Eigen::Matrix3d edges;
  for (int i = 0; i < 3; ++i) edges.row(i) = (w[static_cast<uint32_t>(i) + 1] - w[0]).transpose();
  const double volume = std::abs(edges.determinant()) / 6.0;
  double area = 0.0;
  double shortest = 1e9;
  for (uint32_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d& a = w[(i + 1) % 4];
    area += 0.5 * (w[(i + 2) % 4] - a).cross(w[(i + 3) % 4] - a).norm();
    for (uint32_t j = 0; j < i; ++j) shortest = std::min(shortest, (w[i] - w[j]).norm());
  }
  const Eigen::Vector3d centre = edges.inverse() * (0.5 * edges.rowwise().squaredNorm());
  const double circumradius = centre.norm();
  return Quality{3.0 * (3.0 * volume / area) / circumradius, circumradius / shortest};
}

TEST(MeshQuality, OnlyThreeShapesOccur) {
  constexpr double kAspectRatio[3] = {0.717, 0.641, 0.701};
  constexpr double kRadiusToEdge[3] = {0.866, 0.866, 1.118};
  Random random(11);
  auto forest = roots_of<Deep>(notched_block());
  for (int i = 0; i < 2000; ++i) {
    const Leaf& leaf = forest->leaf[random.below(forest->leaf_count)];
    if (leaf.level() < 14) {
      ASSERT_NE(bisect_with_closure(*forest, leaf.tet), 0u);
    }
  }
  const reference::Mesh mesh = reference::mesh_of(*forest, 1.0);
  double worst_aspect = 1.0;
  double worst_radius = 0.0;
  for (uint32_t i = 0; i < forest->leaf_count; ++i) {
    const auto& tet = mesh.tet[i];
    const Quality quality =
        quality_of({mesh.rest[tet[0]], mesh.rest[tet[1]], mesh.rest[tet[2]], mesh.rest[tet[3]]});
    const auto type = static_cast<uint32_t>(type_of_level(forest->leaf[i].level()));
    ASSERT_NEAR(quality.aspect_ratio, kAspectRatio[type], 5e-4);
    ASSERT_NEAR(quality.radius_to_edge, kRadiusToEdge[type], 5e-4);
    worst_aspect = std::min(worst_aspect, quality.aspect_ratio);
    worst_radius = std::max(worst_radius, quality.radius_to_edge);
  }
  EXPECT_GE(worst_aspect, 0.64);
  EXPECT_LT(worst_radius, 1.12);
}

/// Nodes, and tets at a node, stay within what the mass format and the profiles count on.
TEST(MeshQuality, AtMost48TetsMeetAtANode) {
  Random random(12);
  auto forest = roots_of<Deep>(full_block(2, 2, 2));
  for (int i = 0; i < 3000; ++i) {
    const Leaf& leaf = forest->leaf[random.below(forest->leaf_count)];
    if (leaf.level() < 9) {
      ASSERT_NE(bisect_with_closure(*forest, leaf.tet), 0u);
    }
  }
  std::vector<uint32_t> tets(Deep::kNodes, 0);
  for (uint32_t i = 0; i < forest->leaf_count; ++i) {
    for (const uint16_t node : forest->leaf[i].node) ++tets[node];
  }
  uint32_t least = 1000;
  uint32_t most = 0;
  for (uint32_t i = 0; i < forest->nodes.used(); ++i) {
    least = std::min(least, tets[forest->nodes.live(i)]);
    most = std::max(most, tets[forest->nodes.live(i)]);
  }
  std::printf("%u to %u tets meet at a node\n", least, most);
  EXPECT_LE(most, 48u);
}

}  // namespace
}  // namespace palpate::test
