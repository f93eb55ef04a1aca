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

/// x(X) is linear in a tet: F = sum over i of x_i gradient_i^T.
struct Element {
  std::array<uint32_t, 4> node;
  std::array<Vector, 4> gradient;  // of the node's shape function, 1/m
  double volume;                   // m3
  uint32_t region;
};

/// Gradients from the inverse of the rest edge matrix.
Element element_of(const Mesh& mesh, uint32_t tet);
std::vector<Element> elements_of(const Mesh& mesh);

Matrix deformation_gradient(const Element& element, const Positions& x);

/// A quarter of each tet's mass to each of its nodes, kg.
std::vector<double> lumped_masses(const Mesh& mesh, const std::vector<Material>& materials);

}  // namespace palpate::reference
