// Sparse stiffness over the coordinates of the nodes that are free to move.
#pragma once

#include <Eigen/Sparse>
#include <vector>

#include "reference/elastic_model.hpp"

namespace palpate::reference {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Numbers the coordinates of free nodes 0 .. coordinates() - 1.
class FreeNodes {
 public:
  explicit FreeNodes(const std::vector<bool>& fixed) : first_(fixed.size(), kFixed) {
    for (uint32_t node = 0; node < fixed.size(); ++node) {
      if (fixed[node]) continue;
      first_[node] = coordinates_;
      coordinates_ += 3;
    }
  }
  [[nodiscard]] bool is_free(uint32_t node) const { return first_[node] != kFixed; }
  [[nodiscard]] Eigen::Index first_coordinate(uint32_t node) const { return first_[node]; }
  [[nodiscard]] Eigen::Index coordinates() const { return coordinates_; }

 private:
  static constexpr Eigen::Index kFixed = -1;
  std::vector<Eigen::Index> first_;
  Eigen::Index coordinates_ = 0;
};

/// - d f / d x at x, N/m.
template <uint32_t Nodes>
SparseMatrix assemble_stiffness(const std::vector<ElementOf<Nodes>>& elements,
                                const std::vector<Material>& materials, const Positions& x,
                                const FreeNodes& free, Tangent kind,
                                ElasticModel model = ElasticModel::kCorotation) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(elements.size() * 9 * Nodes * Nodes);
  for (const ElementOf<Nodes>& element : elements) {
    const TangentOf<Nodes> k =
        tangent_of(element, deformation_gradient(element, x), materials[element.region], kind, model);
    for (uint32_t a = 0; a < 3 * Nodes; ++a) {
      for (uint32_t b = 0; b < 3 * Nodes; ++b) {
        const uint32_t row = element.node[a / 3];
        const uint32_t column = element.node[b / 3];
        if (!free.is_free(row) || !free.is_free(column)) continue;
        entries.emplace_back(free.first_coordinate(row) + a % 3, free.first_coordinate(column) + b % 3,
                             k(a, b));
      }
    }
  }
  SparseMatrix stiffness(free.coordinates(), free.coordinates());
  stiffness.setFromTriplets(entries.begin(), entries.end());
  return stiffness;
}

}  // namespace palpate::reference
