// One tet of every level and orientation that bisection makes, at rest on the lattice.
#pragma once

#include <set>
#include <vector>

#include "reference/mesh.hpp"
#include "support/forests.hpp"

namespace palpate::test {

struct Shape {
  uint8_t level;
  Axes axes;
  std::array<LatticePoint, 4> corner;

  /// The same tet as the reference sees it, in cube edges.
  [[nodiscard]] reference::Element element() const {
    reference::Mesh mesh;
    for (const LatticePoint p : corner) {
      mesh.rest.push_back(reference::Vector(p.x, p.y, p.z) / double{kLatticeStepsPerEdge});
    }
    mesh.tet.push_back({0, 1, 2, 3});
    mesh.region.push_back(0);
    return reference::element_of(mesh, 0);
  }
};

/// Every pair of level and axes that occurs in a cube, down to `deepest`, at most 12.
inline std::vector<Shape> all_shapes(uint8_t deepest) {
  std::vector<Shape> shapes;
  std::set<std::pair<uint8_t, uint16_t>> seen;
  auto forest = roots_of<Deep>(full_block(1, 1, 1));
  for (uint8_t level = 0; level <= deepest; ++level) {
    if (refine_uniformly(*forest, level) != MeshStatus::kDone) return {};
    for (uint32_t i = 0; i < forest->leaf_count; ++i) {
      const Leaf& leaf = forest->leaf[i];
      if (!seen.emplace(leaf.level(), leaf.axes().code()).second) continue;
      Shape shape{leaf.level(), leaf.axes(), {}};
      for (uint32_t k = 0; k < 4; ++k) shape.corner[k] = forest->node.rest[leaf.node[k]];
      shapes.push_back(shape);
    }
  }
  return shapes;
}

}  // namespace palpate::test
