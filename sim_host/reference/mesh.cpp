#include "reference/mesh.hpp"

#include <cmath>

namespace palpate::reference {

Material material_of(double youngs_modulus_pa, double poisson_ratio, double density_kg_m3) {
  const double mu = youngs_modulus_pa / (2.0 * (1.0 + poisson_ratio));
  const double lambda =
      youngs_modulus_pa * poisson_ratio / ((1.0 + poisson_ratio) * (1.0 - 2.0 * poisson_ratio));
  return Material{mu, lambda, density_kg_m3};
}

Element element_of(const Mesh& mesh, uint32_t tet) {
  Element element{};
  element.node = mesh.tet[tet];
  element.region = mesh.region[tet];
  const Vector& origin = mesh.rest[element.node[0]];
  Matrix edges;
  for (uint32_t i = 0; i < 3; ++i) edges.col(i) = mesh.rest[element.node[i + 1]] - origin;
  element.volume = std::abs(edges.determinant()) / 6.0;
  const Matrix inverse = edges.inverse();
  element.gradient[0].setZero();
  for (uint32_t i = 0; i < 3; ++i) {
    element.gradient[i + 1] = inverse.row(i).transpose();
    element.gradient[0] -= element.gradient[i + 1];
  }
  return element;
}

std::vector<Element> elements_of(const Mesh& mesh) {
  std::vector<Element> elements;
  elements.reserve(mesh.tet.size());
  for (uint32_t t = 0; t < mesh.tet.size(); ++t) elements.push_back(element_of(mesh, t));
  return elements;
}

std::vector<double> lumped_masses(const Mesh& mesh, const std::vector<Material>& materials) {
  std::vector<double> mass(mesh.rest.size(), 0.0);
  for (const Element& element : elements_of(mesh)) {
    for (const uint32_t node : element.node) {
      mass[node] += materials[element.region].density * element.volume / 4.0;
    }
  }
  return mass;
}

}  // namespace palpate::reference
