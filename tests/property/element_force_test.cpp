// The fixed-point deformation gradient and corotated force of single tets against doubles.
#include "palpate/elastic/element_force.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "any_seed.hpp"
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
  static const std::vector<Shape> all = all_shapes(12);
  return all;
}

struct Deformed {
  std::array<Vector3<Position>, 4> w;
  reference::Positions x;  // the same, as doubles
};

Deformed deform(const Shape& shape, const Matrix3d& f, const Vector3d& shift) {
  Deformed deformed;
  for (uint32_t i = 0; i < 4; ++i) {
    const LatticePoint p = shape.corner[i];
    deformed.w[i] =
        fixed_vector<Position>(f * Vector3d(p.x, p.y, p.z) / double{kLatticeStepsPerEdge} + shift);
    deformed.x.push_back(doubles(deformed.w[i]));
  }
  return deformed;
}

EdgeVectors edges_of(const Shape& shape, const Deformed& d) {
  return edge_vectors(type_of_level(shape.level), d.w[0], d.w[1], d.w[2], d.w[3]);
}

Matrix3d strong_deformation(Random& random) {
  const Vector3d stretches = random.between(0.6, 1.5);
  const Matrix3d r = random.rotation();
  return r * stretches.asDiagonal() * random.rotation();
}

TEST(ElementForce, ShapesCoverAllTypesAndOrientations) {
  uint32_t of_type[3] = {0, 0, 0};
  uint8_t deepest = 0;
  for (const Shape& shape : shapes()) {
    ++of_type[static_cast<uint32_t>(type_of_level(shape.level))];
    deepest = std::max(deepest, shape.level);
  }
  std::printf("%zu shapes, of each type %u, %u, %u, down to level %u\n", shapes().size(), of_type[0],
              of_type[1], of_type[2], unsigned{deepest});
  for (const uint32_t count : of_type) EXPECT_GE(count, 24u);
  EXPECT_EQ(deepest, 12);
}

/// Exact from level 3 on; above it one bit is dropped, half an LSB of 2^-26.
TEST(DeformationGradientProperty, AgreesWithTheInverseOfTheRestMatrix) {
  Random random(31);
  for (const Shape& shape : shapes()) {
    const reference::Element element = shape.element();
    for (int i = 0; i < 50; ++i) {
      const Matrix3d strong = 2.0 * strong_deformation(random);
      const Deformed d = deform(shape, strong, random.vector());
      uint32_t clamped = 0;
      const Matrix3d f = doubles(deformation_gradient(edges_of(shape, d), shape.axes, shape.level, clamped));
      const double bound = shape.level < 3 ? std::ldexp(0.5, -26) : 0.0;
      ASSERT_EQ(clamped, 0u);
      ASSERT_LE((f - reference::deformation_gradient(element, d.x)).cwiseAbs().maxCoeff(), bound + 1e-13);
    }
  }
}

TEST(DeformationGradientProperty, IsClampedAtTheStretchLimit) {
  for (const Shape& shape : shapes()) {
    const Deformed d = deform(shape, Vector3d(9.0, 1.0, 1.0).asDiagonal(), Vector3d::Zero());
    uint32_t clamped = 0;
    const Matrix3d f = doubles(deformation_gradient(edges_of(shape, d), shape.axes, shape.level, clamped));
    EXPECT_NE(clamped, 0u);
    EXPECT_EQ(f(0, 0), kStretchLimit);
    EXPECT_EQ(f(1, 1), 1.0);
  }
}

/// Error of an entry of A = R^T F in LSB of 2^-27: its own rounding, and F's where the tet is large.
double gradient_error(uint8_t level) { return size_of_level(level) == 0 ? 0.5 + std::sqrt(3.0) : 0.5; }

/// Error bound of a component of t_k in LSB of 2^-25, from the roundings on its way (u = 2^-27) after A's:
///   tr(e)           3 entries of A
///   sigma           bulk tr(e) + 2 shear A + 2 u (two roundings to 2^-26)
///   P = R sigma     sqrt(3) times that + 1 u
///   t = P / 2^shift a quarter of an LSB a u, and its own rounding
double edge_force_bound(const Material& material, uint8_t level, double a_error) {
  const double stress =
      (3.0 * sim::to_double(material.bulk) + 2.0 * sim::to_double(material.shear)) * a_error + 2.0;
  const int shift = 2 * size_of_level(level) + static_cast<int>(type_of_level(level));
  return std::ldexp(0.25 * (std::sqrt(3.0) * stress + 1.0), -shift) + 0.5;
}

struct Elastic {
  Material fixed;
  reference::Material exact;
};

/// E = E_ref, so forces come out in E_ref edge^2; the reference gets the rounded coefficients back.
Elastic elastic_of(double poisson_ratio) {
  const reference::Material wished = reference::material_of(1.0, poisson_ratio, 1.0);
  const Material fixed{sim::to_fixed<ShearCoefficient>(wished.mu / 6.0),
                       sim::to_fixed<BulkCoefficient>(wished.lambda / 6.0)};
  return Elastic{fixed, {6.0 * sim::to_double(fixed.shear), 6.0 * sim::to_double(fixed.bulk), 1.0}};
}

struct Compared {
  double worst_over_bound = 0.0;
  double worst_lsb = 0.0;
};

void compare_forces(const Shape& shape, const Deformed& d, const Matrix3d& rotation, const Elastic& elastic,
                    Compared& compared) {
  const RotationMatrix r = fixed_matrix<RotationEntry>(rotation);
  uint32_t clamped = 0;
  const EdgeForces t =
      corotated_edge_forces(edges_of(shape, d), shape.axes, shape.level, r, elastic.fixed, clamped);
  std::array<Vector3<Force>, 4> f;
  for (auto& node : f) node = zero_vector<Force>();
  add_nodal_forces(type_of_level(shape.level), t, f[0], f[1], f[2], f[3]);
  const Vector3<Force> sum = f[0] + f[1] + f[2] + f[3];
  ASSERT_EQ(sum, zero_vector<Force>());
  if (clamped != 0) return;
  const reference::Element element = shape.element();
  const reference::ElementForces expected =
      reference::forces_of(element, reference::deformation_gradient(element, d.x), doubles(r), elastic.exact);
  // A nodal force is made of at most 4 edge forces (f2 of TYPE2).
  const double bound = edge_force_bound(elastic.fixed, shape.level, gradient_error(shape.level));
  for (uint32_t i = 0; i < 4; ++i) {
    double parts = 0.0;
    for (uint32_t k = 0; k < 3; ++k) {
      parts += std::abs(kEdgeCoefficients[static_cast<uint32_t>(type_of_level(shape.level))][k][i]);
    }
    const double error =
        std::ldexp((doubles(f[i]) - expected[i]).cwiseAbs().maxCoeff(), Force::kFractionBits);
    compared.worst_lsb = std::max(compared.worst_lsb, error / parts);
    compared.worst_over_bound = std::max(compared.worst_over_bound, error / (parts * bound));
    ASSERT_LE(error, parts * bound) << "level " << unsigned{shape.level} << " node " << i;
  }
}

/// With rotations that are not the tet's own, as a group's are not.
TEST(ElementForce, AgreesWithDoubles) {
  Random random(32);
  for (const double poisson_ratio : {0.0, 0.3, 0.45, 0.49, 0.495}) {
    const Elastic elastic = elastic_of(poisson_ratio);
    Compared compared;
    for (const Shape& shape : shapes()) {
      for (int i = 0; i < 60; ++i) {
        const double strength = random.unit();
        const Matrix3d r = random.rotation();
        const Matrix3d stretch = Matrix3d::Identity() + strength * 0.3 * random.matrix();
        const Matrix3d groups = r * Eigen::AngleAxisd(0.5 * strength, random.direction()).toRotationMatrix();
        ASSERT_NO_FATAL_FAILURE(
            compare_forces(shape, deform(shape, r * stretch, random.vector()), groups, elastic, compared));
      }
    }
    std::printf("nu %.3f: worst error %.1f LSB of an edge force, %.2f of its bound\n", poisson_ratio,
                compared.worst_lsb, compared.worst_over_bound);
    EXPECT_GT(compared.worst_lsb, 0.3);
  }
}

/// Sums to exactly zero whatever happens on the way, clamped or not.
RC_GTEST_PROP(ElementForce, SumsToZero, ()) {
  Random random(any_seed());
  const Elastic elastic = elastic_of(0.495 * random.unit());
  const Shape& shape = shapes()[random.below(static_cast<uint32_t>(shapes().size()))];
  Matrix3d f;
  for (int i = 0; i < 9; ++i) f.data()[i] = 4.0 * random.centred();
  Deformed d = deform(shape, f, Vector3d::Zero());
  for (auto& w : d.w) w = within_position_limit(w);
  uint32_t clamped = 0;
  const EdgeForces t =
      corotated_edge_forces(edges_of(shape, d), shape.axes, shape.level,
                            fixed_matrix<RotationEntry>(random.rotation()), elastic.fixed, clamped);
  std::array<Vector3<Force>, 4> forces;
  for (auto& node : forces) node = zero_vector<Force>();
  add_nodal_forces(type_of_level(shape.level), t, forces[0], forces[1], forces[2], forces[3]);
  const Vector3<Force> sum = forces[0] + forces[1] + forces[2] + forces[3];
  RC_ASSERT(sum == zero_vector<Force>());
}

/// Turned and carried off without deformation, a tet feels nothing beyond the bound of a force's error.
TEST(ElementForce, RigidMotionGivesNoForce) {
  Random random(33);
  const Elastic elastic = elastic_of(0.49);
  double worst = 0.0;
  for (const Shape& shape : shapes()) {
    for (int i = 0; i < 30; ++i) {
      const Matrix3d r = random.rotation();
      const Deformed d = deform(shape, r, random.vector());
      const EdgeVectors edges = edges_of(shape, d);
      uint32_t clamped = 0;
      const DeformationGradient f = deformation_gradient(edges, shape.axes, shape.level, clamped);
      Quaternion q = fixed_quaternion(r);
      extract_rotation(f, q);
      const EdgeForces t =
          corotated_edge_forces(edges, shape.axes, shape.level, rotation_matrix(q), elastic.fixed, clamped);
      // Positions are rounded too: half an LSB each end makes |F - R| up to 2 sqrt(3) h^-1 2^-27.
      const double strain = std::ldexp(3.47, size_of_level(shape.level));
      // The rotation is off by some LSB of 2^-30.
      const double a_error = gradient_error(shape.level) + strain + 1.0;
      const double bound = edge_force_bound(elastic.fixed, shape.level, a_error);
      for (const auto& part : {t.t1, t.t2, t.t3}) {
        const double lsb = std::ldexp(doubles(part).cwiseAbs().maxCoeff(), Force::kFractionBits);
        worst = std::max(worst, lsb);
        ASSERT_LE(lsb, bound);
      }
    }
  }
  std::printf("worst edge force of a rigid motion: %.0f LSB\n", worst);
}

}  // namespace
}  // namespace palpate::test
