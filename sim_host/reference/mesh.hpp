// A tetrahedral body in plain arrays and SI units, and what elasticity needs of each element.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstdint>
#include <vector>

namespace palpate::reference {

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;
using Positions = std::vector<Vector>;

struct Material {
  double mu;       // Pa
  double lambda;   // Pa
  double density;  // kg/m3
};

Material material_of(double youngs_modulus_pa, double poisson_ratio, double density_kg_m3);

struct Mesh {
  Positions rest;                            // m
  std::vector<std::array<uint32_t, 4>> tet;  // nodes, in any order
  std::vector<uint32_t> region;              // of each tet, an index of the materials
};

/// A point at which stress is evaluated, with the volume that it stands for: F = sum over i of x_i
/// gradient_i^T. A linear tet is one such point with its four nodes, a quadratic one is four points with ten
/// nodes.
template <uint32_t Nodes>
struct ElementOf {
  std::array<uint32_t, Nodes> node;
  std::array<Vector, Nodes> gradient;  // of the node's shape function, 1/m; they add up to zero
  double volume;                       // m3
  uint32_t region;
};
using Element = ElementOf<4>;

/// Gradients from the inverse of the rest edge matrix.
Element element_of(const Mesh& mesh, uint32_t tet);
std::vector<Element> elements_of(const Mesh& mesh);

/// From differences to the first node, so that a far translation costs no digits.
template <uint32_t Nodes>
Matrix deformation_gradient(const ElementOf<Nodes>& element, const Positions& x) {
  Matrix f = Matrix::Zero();
  for (uint32_t i = 1; i < Nodes; ++i) {
    f += (x[element.node[i]] - x[element.node[0]]) * element.gradient[i].transpose();
  }
  return f;
}

/// A quarter of each tet's mass to each of its nodes, kg.
std::vector<double> lumped_masses(const Mesh& mesh, const std::vector<Material>& materials);

}  // namespace palpate::reference
