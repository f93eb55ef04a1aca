// Quadratic tets, judged by fields that they hold exactly.
#include "reference/quadratic_tets.hpp"

#include <gtest/gtest.h>

#include "reference/static_solver.hpp"
#include "support/random.hpp"

namespace palpate::reference {
namespace {

using test::Random;

Mesh two_tets(Random& random) {
  Mesh mesh;
  mesh.rest = {Vector(0, 0, 0), Vector(1, 0, 0), Vector(0, 1, 0), Vector(0, 0, 1), Vector(1, 1, 1)};
  for (Vector& x : mesh.rest) x += 0.1 * random.vector();
  mesh.tet = {{0, 1, 2, 3}, {4, 1, 2, 3}};
  mesh.region = {0, 0};
  return mesh;
}

TEST(QuadraticTets, ShareTheirEdgesAndVolume) {
  Random random(91);
  const Mesh mesh = two_tets(random);
  const QuadraticBody body = quadratic_body(mesh);
  EXPECT_EQ(body.mesh.rest.size(), 5u + 9u);
  EXPECT_EQ(body.elements.size(), 8u);
  double volume = 0.0;
  for (const ElementOf<10>& element : body.elements) volume += element.volume;
  EXPECT_NEAR(volume, element_of(mesh, 0).volume + element_of(mesh, 1).volume, 1e-15);
}

/// x_i = X . Q_i X / 2 + A X is quadratic: F_ij = (Q_i X)_j + A_ij at the points, which are where the shape
/// functions put them.
TEST(QuadraticTets, HoldAQuadraticFieldExactly) {
  Random random(92);
  const QuadraticBody body = quadratic_body(two_tets(random));
  const Matrix a = random.matrix();
  std::array<Matrix, 3> q;
  for (Matrix& m : q) {
    const Matrix any = random.matrix();
    m = any + any.transpose();
  }
  Positions x;
  for (const Vector& p : body.mesh.rest) {
    Vector at = a * p;
    for (int i = 0; i < 3; ++i) at[i] += 0.5 * p.dot(q[static_cast<std::size_t>(i)] * p);
    x.push_back(at);
  }
  for (uint32_t e = 0; e < body.elements.size(); ++e) {
    const auto& corner = body.mesh.tet[e / 4];
    Vector at = Vector::Zero();
    for (uint32_t i = 0; i < 4; ++i) {
      at += (i == e % 4 ? 0.58541019662496845 : 0.13819660112501051) * body.mesh.rest[corner[i]];
    }
    Matrix expected = a;
    for (int i = 0; i < 3; ++i) expected.row(i) += (q[static_cast<std::size_t>(i)] * at).transpose();
    EXPECT_LT((deformation_gradient(body.elements[e], x) - expected).norm(), 1e-13);
  }
}

/// The patch test: an affine deformation needs no force on the inner nodes, and stretches like a bar.
TEST(QuadraticTets, PassThePatchTest) {
  Random random(93);
  const QuadraticBody body = quadratic_body(two_tets(random));
  const std::vector<Material> materials = {material_of(500, 0.3, 1000)};
  const Matrix f = Matrix::Identity() + 0.1 * random.matrix();
  Positions x;
  for (const Vector& p : body.mesh.rest) x.push_back(f * p);
  double volume = 0.0;
  for (const ElementOf<10>& element : body.elements) volume += element.volume;
  for (const ElasticModel model :
       {ElasticModel::kCorotation, ElasticModel::kStVenantKirchhoff, ElasticModel::kLinear}) {
    EXPECT_NEAR(static_energy(body.elements, materials, x, model), volume * energy_of(model, f, materials[0]),
                1e-12);
    // Work done by the nodal forces in an affine motion is the stress power.
    const Matrix p = stress_of(model, f, materials[0]);
    const std::vector<Vector> force = static_forces(body.elements, materials, x, model);
    Matrix virial = Matrix::Zero();
    for (uint32_t i = 0; i < x.size(); ++i) virial += force[i] * body.mesh.rest[i].transpose();
    EXPECT_LT((virial + volume * p).norm(), 1e-11);
  }
}

}  // namespace
}  // namespace palpate::reference
