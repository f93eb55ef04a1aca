// What a tet's force must mean, whatever its arithmetic: the slope of an energy, Young's modulus in a pull,
// and a way back out of inversion.
#include <gtest/gtest.h>

#include "palpate/elastic/element_force.hpp"
#include "reference/corotation.hpp"
#include "reference/polar_rotation.hpp"
#include "support/fixed.hpp"
#include "support/random.hpp"
#include "support/shapes.hpp"

namespace palpate::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const std::vector<Shape>& shapes() {
  static const std::vector<Shape> all = all_shapes(8);
  return all;
}

Material material_of(double nu) {
  const reference::Material exact = reference::material_of(1.0, nu, 1.0);
  return Material{sim::to_fixed<ShearCoefficient>(exact.mu / 6.0),
                  sim::to_fixed<BulkCoefficient>(exact.lambda / 6.0)};
}

struct Result {
  std::array<Vector3d, 4> force;
  EdgeForces edge;
  uint32_t clamped;
};

/// The forces of a tet whose nodes are at x = f X, with its own exact rotation.
Result forces_at(const Shape& shape, const reference::Positions& x, const Material& material) {
  const reference::Matrix f = reference::deformation_gradient(shape.element(), x);
  std::array<Vector3<Position>, 4> w;
  for (uint32_t i = 0; i < 4; ++i) w[i] = fixed_vector<Position>(x[i]);
  Result result{{}, {}, 0};
  result.edge = corotated_edge_forces(
      edge_vectors(type_of_level(shape.level), w[0], w[1], w[2], w[3]), shape.axes, shape.level,
      fixed_matrix<RotationEntry>(reference::polar_rotation(f)), material, result.clamped);
  std::array<Vector3<Force>, 4> force;
  for (auto& node : force) node = zero_vector<Force>();
  add_nodal_forces(type_of_level(shape.level), result.edge, force[0], force[1], force[2], force[3]);
  for (uint32_t i = 0; i < 4; ++i) result.force[i] = doubles(force[i]);
  return result;
}

reference::Positions moved_by(const Shape& shape, const Matrix3d& f) {
  reference::Positions x;
  for (const LatticePoint p : shape.corner)
    x.push_back(f * Vector3d(p.x, p.y, p.z) / double{kLatticeStepsPerEdge});
  return x;
}

TEST(ElasticEnergy, ForceIsMinusItsGradient) {
  Random random(71);
  const Material material = material_of(0.49);
  const reference::Material exact = reference::material_of(1.0, 0.49, 1.0);
  double worst = 0.0;
  for (const Shape& shape : shapes()) {
    const reference::Element element = shape.element();
    Matrix3d f = Matrix3d::Identity();
    for (int i = 0; i < 9; ++i) f.data()[i] += 0.05 * random.centred();
    reference::Positions x = moved_by(shape, random.rotation() * f);
    const Result result = forces_at(shape, x, material);
    ASSERT_EQ(result.clamped, 0u);
    const double h = 1e-6;
    for (uint32_t k = 0; k < 12; ++k) {
      double& coordinate = x[k / 3][k % 3];
      const double at = coordinate;
      coordinate = at + h;
      const double above = reference::corotated_energy(reference::deformation_gradient(element, x), exact);
      coordinate = at - h;
      const double below = reference::corotated_energy(reference::deformation_gradient(element, x), exact);
      coordinate = at;
      const double slope = element.volume * (above - below) / (2 * h);
      worst = std::max(worst, std::abs(slope + result.force[k / 3][k % 3]));
    }
  }
  std::printf("force against the energy's slope: %.1f LSB\n", worst / kForceLsb);
  EXPECT_LT(worst, 40 * kForceLsb);  // 4 edge forces of 7 LSB each, and the differences' own error
}

/// A pull along each axis with free sides: sigma = E e on a face of h^2, of which TYPE0 carries a sixth.
TEST(ElasticEnergy, UniaxialStretchGivesYoungsModulus) {
  const double e = 0.01;
  for (const double nu : {0.0, 0.3, 0.49}) {
    const Material material = material_of(nu);
    for (const Shape& shape : shapes()) {
      for (uint32_t axis = 0; axis < 3; ++axis) {
        Vector3d stretch = Vector3d::Constant(1 - nu * e);
        stretch[axis] = 1 + e;
        const Result result = forces_at(shape, moved_by(shape, stretch.asDiagonal()), material);
        const double shift =
            2.0 * size_of_level(shape.level) + static_cast<double>(type_of_level(shape.level));
        for (uint32_t k = 0; k < 3; ++k) {
          const Vector3<Force>& t = k == 0 ? result.edge.t1 : k == 1 ? result.edge.t2 : result.edge.t3;
          Vector3d expected = Vector3d::Zero();
          if (shape.axes.axis(k) == axis)
            expected[axis] = (shape.axes.is_negative(k) ? -e : e) / 6 * std::exp2(-shift);
          ASSERT_LT((doubles(t) - expected).cwiseAbs().maxCoeff(), 16 * kForceLsb);
        }
      }
    }
  }
}

/// From inside out, each axis in turn and by any amount: the force does positive work on the way back to
/// rest.
TEST(ElasticEnergy, InvertedTetsPushBack) {
  Random random(72);
  const Material material = material_of(0.49);
  for (const Shape& shape : shapes()) {
    for (uint32_t i = 0; i < 12; ++i) {
      Vector3d stretch = random.between(0.8, 1.2);
      stretch[i % 3] = -0.05 - 0.6 * random.unit();
      const Matrix3d q = random.rotation();
      const Matrix3d r = random.rotation();
      const Matrix3d f = r * q * stretch.asDiagonal() * q.transpose();
      const reference::Positions x = moved_by(shape, f);
      const Result result = forces_at(shape, x, material);
      const Matrix3d own = reference::polar_rotation(f);
      double work = 0.0;
      for (uint32_t node = 0; node < 4; ++node) {
        const LatticePoint p = shape.corner[node];
        const Vector3d rest = own * Vector3d(p.x, p.y, p.z) / double{kLatticeStepsPerEdge};
        work += result.force[node].dot(rest - x[node]);
      }
      ASSERT_GT(work, 0.0);
    }
  }
}

/// A tet that is squashed to nothing, or everything at one point, has a finite force.
TEST(ElasticEnergy, FlatTetsHaveAForceAndNoClampedPosition) {
  const Material material = material_of(0.49);
  for (const Shape& shape : shapes()) {
    const Result flat = forces_at(shape, moved_by(shape, Vector3d(1, 1, 0).asDiagonal()), material);
    EXPECT_GT(flat.force[0].norm() + flat.force[1].norm() + flat.force[2].norm() + flat.force[3].norm(), 0.0);
    const Result point = forces_at(shape, moved_by(shape, Matrix3d::Zero()), material);
    EXPECT_NE(point.clamped, 0u);  // sigma = -(2 mu + 3 lambda) is beyond 4 E at nu = 0.49
  }
}

}  // namespace
}  // namespace palpate::test
