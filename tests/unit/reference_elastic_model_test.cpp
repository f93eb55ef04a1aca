// The three models of the reference, judged by calculus and by closed formulas.
#include "reference/elastic_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>

#include "reference/polar_rotation.hpp"
#include "support/random.hpp"

namespace palpate::reference {
namespace {

using test::Random;

constexpr ElasticModel kModels[] = {ElasticModel::kCorotation, ElasticModel::kStVenantKirchhoff,
                                    ElasticModel::kLinear};

Matrix any_gradient(Random& random) {
  return random.rotation() * (Matrix::Identity() + 0.25 * random.matrix());
}

/// d g(h) / dh at 0 by central differences of fourth order.
template <class Function>
std::invoke_result_t<Function, double> slope_of(Function g) {
  const double h = 1e-3;
  return (8.0 * (g(h) - g(-h)) - (g(2 * h) - g(-2 * h))) / (12 * h);
}

TEST(ElasticModel, StressIsTheGradientOfTheEnergy) {
  Random random(71);
  const Material material = material_of(500, 0.49, 1000);
  for (const ElasticModel model : kModels) {
    for (int i = 0; i < 200; ++i) {
      const Matrix f = any_gradient(random);
      const Matrix direction = random.matrix();
      const double slope = slope_of([&](double h) { return energy_of(model, f + h * direction, material); });
      const double product = (stress_of(model, f, material).transpose() * direction).trace();
      EXPECT_NEAR(slope, product, 1e-8 * material.lambda);
    }
  }
}

TEST(ElasticModel, TangentIsTheDerivativeOfTheStress) {
  Random random(72);
  const Material material = material_of(500, 0.49, 1000);
  for (const ElasticModel model : kModels) {
    double worst = 0.0;
    for (int i = 0; i < 200; ++i) {
      const Matrix f = any_gradient(random);
      const Matrix direction = random.matrix();
      const StressTangent tangent = stress_tangent_of(model, f, material, Tangent::kExact);
      const Matrix slope =
          slope_of([&](double h) -> Matrix { return stress_of(model, f + h * direction, material); });
      const Eigen::Matrix<double, 9, 1> predicted =
          tangent * Eigen::Map<const Eigen::Matrix<double, 9, 1>>(direction.data());
      const Eigen::Map<const Eigen::Matrix<double, 9, 1>> actual(slope.data());
      worst = std::max(worst, (predicted - actual).norm() / tangent.norm());
      EXPECT_LT((tangent - tangent.transpose()).norm(), 1e-13 * tangent.norm());
    }
    EXPECT_LT(worst, 1e-9);
  }
}

TEST(ElasticModel, PositiveTangentHasNoNegativeEigenvalue) {
  Random random(73);
  const Material material = material_of(500, 0.49, 1000);
  for (const ElasticModel model : kModels) {
    for (int i = 0; i < 100; ++i) {
      const StressTangent tangent =
          stress_tangent_of(model, any_gradient(random), material, Tangent::kPositive);
      const double least = Eigen::SelfAdjointEigenSolver<StressTangent>(tangent).eigenvalues()[0];
      EXPECT_GT(least, -1e-12 * tangent.norm());
    }
  }
}

TEST(ElasticModel, NonlinearOnesTurnWithTheirFrame) {
  Random random(74);
  const Material material = material_of(500, 0.49, 1000);
  for (const ElasticModel model : {ElasticModel::kCorotation, ElasticModel::kStVenantKirchhoff}) {
    for (int i = 0; i < 200; ++i) {
      const Matrix f = any_gradient(random);
      const Matrix q = random.rotation();
      EXPECT_LT((stress_of(model, q * f, material) - q * stress_of(model, f, material)).norm(),
                1e-12 * material.lambda);
      EXPECT_LT(stress_of(model, q, material).norm(), 1e-12 * material.lambda);
    }
  }
}

/// Turned by theta about z the linear model sees e = diag(cos theta - 1, cos theta - 1, 0): it swells.
TEST(ElasticModel, LinearOneTakesARotationForAStrain) {
  const Material material = material_of(500, 0.3, 1000);
  const double c = std::cos(0.5);
  Matrix turned;
  turned << c, -std::sin(0.5), 0, std::sin(0.5), c, 0, 0, 0, 1;
  const Matrix p = stress_of(ElasticModel::kLinear, turned, material);
  const double along = 2 * (material.mu + material.lambda) * (c - 1);
  EXPECT_LT((p - Vector(along, along, 2 * material.lambda * (c - 1)).asDiagonal().toDenseMatrix()).norm(),
            1e-9);
}

/// Sideways free: Green strain E11 along, -nu E11 aside, so S = E E11 and P = (stretch) E E11.
TEST(ElasticModel, UniaxialStretchGivesYoungsModulus) {
  for (const double nu : {0.0, 0.3, 0.49}) {
    const Material material = material_of(500, nu, 1000);
    const double stretch = 1.2;
    const double green = 0.5 * (stretch * stretch - 1);
    const double aside = std::sqrt(1 - 2 * nu * green);
    const Matrix f = Vector(aside, stretch, aside).asDiagonal();
    const Matrix p = stress_of(ElasticModel::kStVenantKirchhoff, f, material);
    EXPECT_NEAR(p(1, 1), stretch * 500 * green, 1e-9);
    EXPECT_NEAR(p(0, 0), 0.0, 1e-9);
    EXPECT_NEAR(energy_of(ElasticModel::kStVenantKirchhoff, f, material), 0.5 * 500 * green * green, 1e-9);

    const double e = stretch - 1;
    const Matrix g = Vector(1 - nu * e, stretch, 1 - nu * e).asDiagonal();
    for (const ElasticModel model : {ElasticModel::kCorotation, ElasticModel::kLinear}) {
      EXPECT_NEAR(stress_of(model, g, material)(1, 1), 500 * e, 1e-9);
      EXPECT_NEAR(stress_of(model, g, material)(0, 0), 0.0, 1e-9);
      EXPECT_NEAR(energy_of(model, g, material), 0.5 * 500 * e * e, 1e-9);
    }
  }
}

}  // namespace
}  // namespace palpate::reference
