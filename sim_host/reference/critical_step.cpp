#include "reference/critical_step.hpp"

#include <Eigen/Sparse>
#include <cmath>

#include "reference/corotation.hpp"
#include "reference/stiffness.hpp"

namespace palpate::reference {
namespace {

constexpr int kMostPowerSteps = 400;
constexpr int kIterationsARound = 50;

/// Not symmetric in any way that the mesh could have, and the same on every run.
Eigen::VectorXd first_guess(Eigen::Index size) {
  Eigen::VectorXd v(size);
  for (Eigen::Index i = 0; i < size; ++i) v[i] = std::sin(1.0 + 12.9898 * static_cast<double>(i));
  return v.normalized();
}

}  // namespace

double largest_angular_frequency(const Mesh& mesh, const std::vector<Material>& materials,
                                 const std::vector<bool>& held) {
  const FreeNodes free(held);
  SparseMatrix k = assemble_stiffness(elements_of(mesh), materials, mesh.rest, free, Tangent::kExact);
  const std::vector<double> mass = lumped_masses(mesh, materials);
  Eigen::VectorXd root(free.coordinates());
  for (uint32_t node = 0; node < mass.size(); ++node) {
    if (free.is_free(node))
      root.segment<3>(free.first_coordinate(node)).setConstant(1.0 / std::sqrt(mass[node]));
  }
  k = (root.asDiagonal() * k * root.asDiagonal()).eval();
  Eigen::VectorXd v = first_guess(free.coordinates());
  double before = 0.0;
  for (int round = 0; round < kMostPowerSteps; ++round) {
    for (int i = 0; i < kIterationsARound; ++i) v = (k * v).normalized();
    const double quotient = v.dot(k * v);
    if (quotient - before < 1e-9 * quotient) return std::sqrt(quotient);
    before = quotient;
  }
  return std::sqrt(before);
}

}  // namespace palpate::reference
