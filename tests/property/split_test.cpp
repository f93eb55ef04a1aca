// What the instant of a split may be felt of: nothing. Positions, motion, energy and forces stay as they
// were.
#include <gtest/gtest.h>

#include "support/moving_bodies.hpp"
#include "support/soak.hpp"

namespace palpate::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Body = ElasticBody<MovingProfile>;

/// Sum of V (mu |e|^2 + lambda/2 tr(e)^2) with the groups' rotations, in doubles.
double elastic_energy(Body& body) {
  const reference::Mesh mesh = reference::mesh_of(body.forest(), 1.0);
  const reference::Positions x = reference::positions_of(body.forest(), 1.0);
  double energy = 0.0;
  for (uint32_t i = 0; i < body.forest().leaf_count; ++i) {
    const Leaf& leaf = body.forest().leaf[i];
    const reference::Element element = reference::element_of(mesh, i);
    const Matrix3d r = doubles(rotation_matrix(body.groups->used[leaf.group]));
    const Matrix3d a = r.transpose() * reference::deformation_gradient(element, x);
    const Matrix3d e = 0.5 * (a + a.transpose()) - Matrix3d::Identity();
    const reference::Material material = exactly(body.materials[leaf.region()]);
    energy +=
        element.volume * (material.mu * e.squaredNorm() + 0.5 * material.lambda * e.trace() * e.trace());
  }
  return energy;
}

struct Motion {
  Vector3d momentum = Vector3d::Zero();  // mass units times LSB of velocity
  double energy = 0.0;                   // the same with its square
};

Motion motion_of(Body& body) {
  Motion motion;
  body.for_nodes([&](uint16_t n) {
    Vector3d v;
    for (int axis = 0; axis < 3; ++axis) v[axis] = body.node().velocity[n][axis].raw();
    motion.momentum += static_cast<double>(body.node().mass[n]) * v;
    motion.energy += 0.5 * static_cast<double>(body.node().mass[n]) * v.squaredNorm();
  });
  return motion;
}

/// x and v of the new node are means, rounded by half an LSB; that is all that a split can change.
TEST(Split, ChangesNeitherMotionNorEnergy) {
  Random random(91);
  double worst_energy = 0.0;
  for (uint32_t round = 0; round < in_soak(10000u, 300u); ++round) {
    Moving m = moving_body(random, 0.3);
    if (m.body.evaluate() != 0) continue;  // a clamped force is not the energy's slope
    const auto positions = m.body.node().position;
    const auto velocities = m.body.node().velocity;
    const Motion before = motion_of(m.body);
    const double elastic = elastic_energy(m.body);
    const Split split = split_at_random(m, random);
    if (split.node == kNone) continue;
    m.body.for_nodes([&](uint16_t n) {
      if (n == split.node) return;
      ASSERT_EQ(m.body.node().position[n], positions[n]);
      ASSERT_EQ(m.body.node().velocity[n], velocities[n]);
    });
    const Motion after = motion_of(m.body);
    const double mass = m.body.node().mass[split.node];
    ASSERT_LE((after.momentum - before.momentum).cwiseAbs().maxCoeff(), 0.5 * mass);
    const double speed = std::ldexp(doubles(m.body.node().velocity[split.node]).lpNorm<1>(), 36);
    ASSERT_LE(after.energy - before.energy, 0.5 * mass * (speed + 1.0));
    // Elastic: the force at the node (itself off by some LSB) times half an LSB of position.
    (void)m.body.evaluate();
    const double force = doubles(m.body.node().force[split.node]).lpNorm<1>();
    const double bound = std::ldexp(force + 24.0 * std::ldexp(1.0, -25), -28) + 1e-14;
    worst_energy = std::max(worst_energy, std::abs(elastic_energy(m.body) - elastic) / bound);
  }
  std::printf("elastic energy changes by at most %.2f of its bound\n", worst_energy);
  EXPECT_LE(worst_energy, 1.0);
}

/// f_a' + f_m / 2 = f_a at both ends, and all other forces as they were, within the rounding of the leaves
/// around. Where the solver evaluates them: at x + beta_K v.
TEST(Split, LeavesTheForcesAsTheyWere) {
  Random random(92);
  double worst_end = 0.0;
  double worst_other = 0.0;
  for (uint32_t round = 0; round < in_soak(10000u, 300u); ++round) {
    Moving m = moving_body(random, 0.5);
    if (m.body.evaluate_at(m.solve->force_position) != 0) continue;
    const auto before = m.body.node().force;
    const Split split = split_at_random(m, random);
    if (split.node == kNone) continue;
    ASSERT_EQ(m.body.evaluate_at(m.solve->force_position), 0u);
    const auto& force = m.body.node().force;
    m.body.for_nodes([&](uint16_t n) {
      if (n == split.node) return;
      const bool is_end = n == split.ends[0] || n == split.ends[1];
      const Vector3d half = is_end ? Vector3d(0.5 * doubles(force[split.node])) : Vector3d(Vector3d::Zero());
      const double lsb = std::ldexp((doubles(force[n]) + half - doubles(before[n])).cwiseAbs().maxCoeff(),
                                    Force::kFractionBits);
      (is_end ? worst_end : worst_other) = std::max(is_end ? worst_end : worst_other, lsb);
    });
  }
  std::printf("forces after a split: ends off by at most %.1f LSB, others by %.1f LSB\n", worst_end,
              worst_other);
  EXPECT_LE(worst_end, 16.0);
  EXPECT_LE(worst_other, 16.0);
}

}  // namespace
}  // namespace palpate::test
