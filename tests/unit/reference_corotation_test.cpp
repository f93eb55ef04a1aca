// The double-precision reference, judged by calculus and by closed formulas.
#include "reference/corotation.hpp"

#include <gtest/gtest.h>

#include "reference/body.hpp"
#include "reference/critical_step.hpp"
#include "reference/polar_rotation.hpp"
#include "reference/static_solver.hpp"
#include "support/random.hpp"

namespace palpate::reference {
namespace {

using test::Random;

Mesh any_tet(Random& random) {
  Mesh mesh;
  mesh.rest = {Vector(0, 0, 0), Vector(1, 0, 0), Vector(0, 1, 0), Vector(0, 0, 1)};
  for (Vector& x : mesh.rest) x += 0.2 * random.vector();
  mesh.tet.push_back({0, 1, 2, 3});
  mesh.region.push_back(0);
  return mesh;
}

Positions deformed(Random& random, const Positions& rest) {
  const Matrix r = random.rotation();
  Positions x;
  for (const Vector& p : rest) x.push_back(r * (p + 0.25 * random.vector()));
  return x;
}

TEST(PolarRotation, IsARotationAndLeavesASymmetricFactor) {
  Random random(61);
  for (int i = 0; i < 5000; ++i) {
    Matrix f;
    for (int k = 0; k < 9; ++k) f.data()[k] = 2.0 * random.centred();
    const Matrix r = polar_rotation(f);
    EXPECT_LT((r.transpose() * r - Matrix::Identity()).norm(), 1e-13);
    EXPECT_NEAR(r.determinant(), 1.0, 1e-13);
    EXPECT_LT(axial_vector(r.transpose() * f).norm(), 1e-13);
  }
}

TEST(PolarRotation, FromAWarmStartIsTheSame) {
  Random random(62);
  for (int i = 0; i < 5000; ++i) {
    Matrix f;
    for (int k = 0; k < 9; ++k) f.data()[k] = random.centred();
    const Eigen::JacobiSVD<Matrix> svd(f);
    if (svd.singularValues()[1] - svd.singularValues()[2] < 0.02 && f.determinant() < 0) continue;
    EXPECT_LT(angle_between(polar_rotation(f), polar_rotation(f, random.rotation())), 1e-12);
  }
}

/// |R1 - R2|^2 = 4 (1 - cos theta), the paper's Eq. 3.
TEST(PolarRotation, DistanceOfRotationsIsTheirAngle) {
  Random random(63);
  for (int i = 0; i < 1000; ++i) {
    const Matrix a = random.rotation();
    const Matrix b = random.rotation();
    EXPECT_NEAR((a - b).squaredNorm(), 4.0 * (1.0 - std::cos(angle_between(a, b))), 1e-13);
  }
}

TEST(Corotation, ForceIsMinusTheGradientOfTheEnergy) {
  Random random(64);
  const Material material = material_of(500, 0.49, 1000);
  double worst = 0.0;
  for (int i = 0; i < 200; ++i) {
    const Mesh mesh = any_tet(random);
    const Element element = element_of(mesh, 0);
    Positions x = deformed(random, mesh.rest);
    const Matrix f = deformation_gradient(element, x);
    const ElementForces forces = forces_of(element, f, polar_rotation(f), material);
    for (uint32_t k = 0; k < 12; ++k) {
      const double h = 1e-5;
      const double at = x[k / 3][k % 3];
      x[k / 3][k % 3] = at + h;
      const double above = corotated_energy(deformation_gradient(element, x), material);
      x[k / 3][k % 3] = at - h;
      const double below = corotated_energy(deformation_gradient(element, x), material);
      x[k / 3][k % 3] = at;
      const double slope = element.volume * (above - below) / (2 * h);
      worst = std::max(worst, std::abs(slope + forces[k / 3][k % 3]) / material.lambda);
    }
  }
  EXPECT_LT(worst, 1e-8);
}

TEST(Corotation, TangentIsTheDerivativeOfTheForce) {
  Random random(65);
  const Material material = material_of(500, 0.49, 1000);
  double worst = 0.0;
  for (int i = 0; i < 200; ++i) {
    const Mesh mesh = any_tet(random);
    const Element element = element_of(mesh, 0);
    Positions x = deformed(random, mesh.rest);
    const ElementTangent k = tangent_of(element, deformation_gradient(element, x), material, Tangent::kExact);
    const auto forces_at = [&] {
      const Matrix f = deformation_gradient(element, x);
      return forces_of(element, f, polar_rotation(f), material);
    };
    for (uint32_t column = 0; column < 12; ++column) {
      const double h = 3e-5;  // central differences of fourth order
      const double at = x[column / 3][column % 3];
      std::array<ElementForces, 5> forces;
      for (uint32_t step = 0; step < 5; ++step) {
        x[column / 3][column % 3] = at + (step - 2.0) * h;
        forces[step] = forces_at();
      }
      x[column / 3][column % 3] = at;
      for (uint32_t row = 0; row < 12; ++row) {
        const auto f = [&](uint32_t at_step) { return forces[at_step][row / 3][row % 3]; };
        const double slope = -(8 * (f(3) - f(1)) - (f(4) - f(0))) / (12 * h);
        worst = std::max(worst, std::abs(slope - k(row, column)) / k.norm());
      }
    }
    EXPECT_LT((k - k.transpose()).norm() / k.norm(), 1e-13);
  }
  std::printf("tangent against differences: %.1e\n", worst);
  EXPECT_LT(worst, 3e-10);
}

TEST(Corotation, TurnsWithItsFrame) {
  Random random(66);
  const Material material = material_of(500, 0.49, 1000);
  for (int i = 0; i < 200; ++i) {
    const Mesh mesh = any_tet(random);
    const Element element = element_of(mesh, 0);
    const Matrix f = deformation_gradient(element, deformed(random, mesh.rest));
    const Matrix q = random.rotation();
    const ElementForces forces = forces_of(element, f, polar_rotation(f), material);
    const ElementForces turned = forces_of(element, q * f, polar_rotation(q * f), material);
    for (uint32_t k = 0; k < 4; ++k) EXPECT_LT((turned[k] - q * forces[k]).norm(), 1e-12 * material.lambda);
  }
}

TEST(Corotation, UniaxialStretchGivesYoungsModulus) {
  for (const double nu : {0.0, 0.3, 0.49}) {
    const Material material = material_of(500, nu, 1000);
    const double e = 0.1;
    const Matrix stretch = Vector(1 - nu * e, 1 + e, 1 - nu * e).asDiagonal();
    const Matrix p = corotated_stress(stretch, Matrix::Identity(), material);
    EXPECT_NEAR(p(1, 1), 500 * e, 1e-9);
    EXPECT_LT((p - Vector(0, p(1, 1), 0).asDiagonal().toDenseMatrix()).norm(), 1e-9);
  }
}

/// A column of two tets' worth of mesh, pulled: the bar formula, sideways free.
TEST(StaticSolver, PullsABarLikeABar) {
  Mesh mesh;
  for (int z = 0; z <= 4; ++z) {
    for (int i = 0; i < 4; ++i) mesh.rest.push_back(0.01 * Vector(i & 1, i >> 1, z));
  }
  constexpr uint32_t kKuhn[6][4] = {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7},
                                    {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}};
  for (uint32_t z = 0; z < 4; ++z) {
    for (const auto& tet : kKuhn) {
      mesh.tet.push_back({4 * z + tet[0], 4 * z + tet[1], 4 * z + tet[2], 4 * z + tet[3]});
      mesh.region.push_back(0);
    }
  }
  const double nu = 0.4;
  StaticProblem problem{mesh, {material_of(500, nu, 1000)}, std::vector<bool>(mesh.rest.size(), false), {}};
  const double e = 0.05;
  for (uint32_t i = 0; i < mesh.rest.size(); ++i) problem.prescribed[i] = i < 4 || i + 4 >= mesh.rest.size();
  problem.place = [&](double load, Positions& x) {
    for (uint32_t i = 0; i < x.size(); ++i) {
      const Vector& p = mesh.rest[i];
      if (problem.prescribed[i]) {
        x[i] = Vector(p[0] * (1 - nu * e * load), p[1] * (1 - nu * e * load), p[2] * (1 + e * load));
      }
    }
  };
  problem.load_steps = 2;
  const StaticSolution solution = solve_static(problem);
  ASSERT_TRUE(solution.converged);
  EXPECT_LT(solution.residual_n, 1e-10);
  double pull = 0.0;
  for (uint32_t i = 0; i < 4; ++i) pull += solution.force[i][2];
  EXPECT_NEAR(pull, 500 * e * 1e-4, 1e-9);
}

/// A spring and a mass: two heavy-free degrees of freedom by hand. One tet with three nodes held has
/// w^2 = (largest eigenvalue of its 3x3 block) / m.
TEST(CriticalStep, OfOneTetIsItsBlocksEigenvalue) {
  Random random(67);
  const Mesh mesh = any_tet(random);
  const std::vector<Material> materials = {material_of(500, 0.3, 10)};
  const Element element = element_of(mesh, 0);
  const ElementTangent k = tangent_of(element, Matrix::Identity(), materials[0], Tangent::kExact);
  const Matrix block = k.bottomRightCorner<3, 3>();
  const double largest = Eigen::SelfAdjointEigenSolver<Matrix>(block).eigenvalues()[2];
  const double mass = lumped_masses(mesh, materials)[3];
  EXPECT_NEAR(largest_angular_frequency(mesh, materials, {true, true, true, false}),
              std::sqrt(largest / mass), 1e-6 * std::sqrt(largest / mass));
}

/// One free node of one tet, without damping, swings with the frequency of its block.
TEST(ReferenceBody, SwingsAtItsFrequency) {
  Mesh mesh;
  mesh.rest = {Vector(0, 0, 0), Vector(0.1, 0, 0), Vector(0, 0.1, 0), Vector(0, 0, 0.1)};
  mesh.tet.push_back({0, 1, 2, 3});
  mesh.region.push_back(0);
  BodyParameters parameters;
  parameters.materials = {material_of(500, 0.0, 1000)};
  parameters.substeps = 4;
  ReferenceBody body(mesh, parameters, {1, 1, 1, 0});
  Positions x = mesh.rest;
  const double amplitude = 1e-6;
  x[3][2] += amplitude;
  body.set_state(x, std::vector<Vector>(4, Vector::Zero()));
  // nu = 0, along z: k = 2 mu V (1/h)^2 = E V / h^2, m = rho V / 4.
  const double w = std::sqrt(500.0 / (0.1 * 0.1) / (1000.0 / 4));
  for (int i = 1; i <= 300; ++i) {
    body.tick(BodyInput{});
    ASSERT_NEAR(body.position()[3][2] - 0.1, amplitude * std::cos(w * i * 1e-3), 0.01 * amplitude);
  }
}

}  // namespace
}  // namespace palpate::reference
