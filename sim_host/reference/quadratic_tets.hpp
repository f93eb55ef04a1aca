// Tets with a node in the middle of each edge, which bend without locking: the yardstick for linear ones near
// nu = 1/2.
#pragma once

#include "reference/mesh.hpp"

namespace palpate::reference {

struct QuadraticBody {
  Mesh mesh;  // with the middle nodes behind the corners in `rest`; tets by their corners
  std::vector<ElementOf<10>> elements;  // four points a tet
};

/// Straight edges, quadrature of degree 2 (Keast): four points with barycentric coordinates a, b, b, b. Shape
/// functions L_i (2 L_i - 1) at corners and 4 L_i L_j on edges.
QuadraticBody quadratic_body(const Mesh& mesh);

}  // namespace palpate::reference
