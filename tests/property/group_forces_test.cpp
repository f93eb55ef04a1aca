// Forces group by group, in the groups' own frames, against forces tet by tet, on any mesh and any front.
#include "palpate/elastic/group_forces.hpp"

#include <gtest/gtest.h>

#include "reference/corotation.hpp"
#include "support/elastic_bodies.hpp"
#include "support/pool_corruptor.hpp"
#include "support/soak.hpp"

namespace palpate::test {
namespace {

using Eigen::Vector3d;
using GroupsProfile = TestProfile<500, 300, 9>;
using Body = ElasticBody<GroupsProfile>;

uint32_t rounds() { return in_soak(5000u, 100u); }

/// Bound of a node's force in LSB of 2^-25, from the roundings on its way in the group's frame (u = 2^-27):
/// positions are rounded once, which makes 2 2^size u in A; then as tet by tet (element_force_test.cpp), a
/// rotation back, and the net rounding of each group at its first node.
std::vector<double> node_bounds(Body& body) {
  std::vector<double> bound(GroupsProfile::kNodes, 0.0);
  for (uint32_t i = 0; i < body.forest().leaf_count; ++i) {
    const Leaf& leaf = body.forest().leaf[i];
    const Material& material = body.materials[leaf.region()];
    const double a_error = std::ldexp(2.0, size_of_level(leaf.level())) + 2.3;
    const double stress =
        (3.0 * sim::to_double(material.bulk) + 2.0 * sim::to_double(material.shear)) * a_error + 2.0;
    const int shift = 2 * size_of_level(leaf.level()) + static_cast<int>(type_of_level(leaf.level()));
    const double edge = std::ldexp(0.25 * (std::sqrt(3.0) * stress + 1.0), -shift) + 0.5;
    for (uint32_t k = 0; k < 4; ++k) {
      double parts = 0.0;
      for (const auto& row : kEdgeCoefficients[static_cast<uint32_t>(type_of_level(leaf.level()))])
        parts += std::abs(row[k]);
      bound[leaf.node[k]] += std::sqrt(3.0) * parts * edge;
    }
  }
  body.for_groups([&](uint16_t g) {
    const Span span = body.front().nodes[g];
    for (uint32_t k = 0; k < span.count; ++k) bound[body.front().node_order[span.begin + k]] += 1.0;
    bound[body.front().node_order[span.begin]] += 0.5 * span.count;
  });
  return bound;
}

/// With each leaf's own force from its group's rotation.
std::vector<Vector3<Force>> forces_one_by_one(Body& body, uint32_t& clamped) {
  std::vector<Vector3<Force>> f(GroupsProfile::kNodes, zero_vector<Force>());
  for (uint32_t i = 0; i < body.forest().leaf_count; ++i) {
    const Leaf& leaf = body.forest().leaf[i];
    const auto& x = body.node().position;
    const TetType type = type_of_level(leaf.level());
    const EdgeForces t = corotated_edge_forces(
        edge_vectors(type, x[leaf.node[0]], x[leaf.node[1]], x[leaf.node[2]], x[leaf.node[3]]), leaf.axes(),
        leaf.level(), rotation_matrix(body.groups->used[leaf.group]), body.materials[leaf.region()], clamped);
    add_nodal_forces(type, t, f[leaf.node[0]], f[leaf.node[1]], f[leaf.node[2]], f[leaf.node[3]]);
  }
  return f;
}

TEST(GroupForces, AreThoseOfTheTetsOneByOne) {
  Random random(71);
  double worst_lsb = 0.0;
  double worst_over_bound = 0.0;
  uint32_t compared = 0;
  for (uint32_t round = 0; round < rounds(); ++round) {
    Body body = random_body<GroupsProfile>(random, 50 + 3 * round % 400);
    deform_at_random(body, random, 0.5 * random.unit());
    uint32_t clamped = 0;
    const auto expected = forces_one_by_one(body, clamped);
    if (body.evaluate() != 0 || clamped != 0) continue;
    ++compared;
    const std::vector<double> bound = node_bounds(body);
    body.for_nodes([&](uint16_t n) {
      const double lsb = std::ldexp(
          (doubles(body.node().force[n]) - doubles(expected[n])).cwiseAbs().maxCoeff(), Force::kFractionBits);
      worst_lsb = std::max(worst_lsb, lsb);
      worst_over_bound = std::max(worst_over_bound, lsb / bound[n]);
    });
  }
  std::printf("%u states: a node's force differs by at most %.1f LSB, %.2f of its bound\n", compared,
              worst_lsb, worst_over_bound);
  EXPECT_GT(compared, rounds() / 2);
  EXPECT_LE(worst_over_bound, 1.0);
  EXPECT_GT(worst_lsb, 1.0);
}

/// And in doubles, where nothing is rounded but the inputs.
TEST(GroupForces, AreThoseOfTheFormula) {
  Random random(72);
  double worst_over_bound = 0.0;
  for (uint32_t round = 0; round < rounds(); ++round) {
    Body body = random_body<GroupsProfile>(random);
    deform_at_random(body, random, 0.5);
    if (body.evaluate() != 0) continue;
    const reference::Mesh mesh = reference::mesh_of(body.forest(), 1.0);
    const reference::Positions x = reference::positions_of(body.forest(), 1.0);
    std::vector<Vector3d> expected(x.size(), Vector3d::Zero());
    for (uint32_t i = 0; i < body.forest().leaf_count; ++i) {
      const reference::Element element = reference::element_of(mesh, i);
      const Leaf& leaf = body.forest().leaf[i];
      const auto f =
          reference::forces_of(element, reference::deformation_gradient(element, x),
                               doubles(body.groups->used[leaf.group]).normalized().toRotationMatrix(),
                               exactly(body.materials[leaf.region()]));
      for (uint32_t k = 0; k < 4; ++k) expected[element.node[k]] += f[k];
    }
    const std::vector<double> bound = node_bounds(body);
    for (uint32_t i = 0; i < x.size(); ++i) {
      const uint16_t n = body.forest().nodes.live(i);
      const double lsb = std::ldexp((doubles(body.node().force[n]) - expected[i]).cwiseAbs().maxCoeff(),
                                    Force::kFractionBits);
      worst_over_bound = std::max(worst_over_bound, lsb / bound[n]);
    }
  }
  std::printf("against doubles: at most %.2f of the bound\n", worst_over_bound);
  EXPECT_LE(worst_over_bound, 1.0);
}

void expect_no_net_force(Body& body) {
  int64_t sum[3] = {0, 0, 0};
  body.for_nodes([&](uint16_t n) {
    for (int axis = 0; axis < 3; ++axis) sum[axis] += body.node().force[n][axis].raw();
  });
  for (const int64_t component : sum) ASSERT_EQ(component, 0);
}

/// Integer sums: whatever the state, clamped or not.
TEST(GroupForces, SumToExactlyZero) {
  Random random(73);
  uint32_t clamped = 0;
  for (uint32_t round = 0; round < rounds(); ++round) {
    Body body = random_body<GroupsProfile>(random);
    deform_at_random(body, random, round % 10 == 0 ? 8.0 : random.unit());
    body.for_nodes(
        [&](uint16_t n) { body.node().position[n] = within_position_limit(body.node().position[n]); });
    clamped += body.evaluate() != 0 ? 1u : 0u;
    ASSERT_NO_FATAL_FAILURE(expect_no_net_force(body));
    body.evaluate<Observe::kNo>();
    ASSERT_NO_FATAL_FAILURE(expect_no_net_force(body));
  }
  EXPECT_GT(clamped, 0u);
}

TEST(GroupForces, AreZeroAtRestForAnyFront) {
  Random random(74);
  for (uint32_t round = 0; round < rounds(); ++round) {
    Body body = random_body<GroupsProfile>(random);
    ASSERT_EQ(body.evaluate(), 0u);
    body.for_nodes([&](uint16_t n) { ASSERT_EQ(body.node().force[n], zero_vector<Force>()); });
    body.for_groups([&](uint16_t g) {
      ASSERT_EQ(body.groups->gradient[g], unstretched());
      ASSERT_EQ(body.groups->misfit[g].raw(), 0);
    });
  }
}

TEST(GroupForces, AreTheSameBitsObservedOrNot) {
  Random random(75);
  Body body = random_body<GroupsProfile>(random);
  deform_at_random(body, random, 0.7);
  body.evaluate<Observe::kYes>();
  const auto observed = body.node().force;
  body.evaluate<Observe::kNo>();
  body.for_nodes([&](uint16_t n) { ASSERT_EQ(body.node().force[n], observed[n]); });
}

/// The groups come in another order, and the leaves and nodes of each too but for the first node, which is
/// the origin of the group's frame: the same bits.
TEST(GroupForces, DoNotDependOnTheOrderOfGroupsAndLeaves) {
  Random random(76);
  for (uint32_t round = 0; round < rounds() / 4; ++round) {
    Body body = random_body<GroupsProfile>(random);
    deform_at_random(body, random, 0.7);
    body.evaluate<Observe::kNo>();
    const auto before = body.node().force;
    RotationFront<GroupsProfile>& front = body.front();
    const uint16_t used = front.groups.used();
    for (uint32_t i = 0; i < used / 2u; ++i) {
      std::swap(PoolCorruptor::order(front.groups, i), PoolCorruptor::order(front.groups, used - 1u - i));
    }
    body.for_groups([&](uint16_t g) {
      const auto leaves = front.leaf_order.begin() + front.leaves[g].begin;
      std::reverse(leaves, leaves + front.leaves[g].count);
      const auto nodes = front.node_order.begin() + front.nodes[g].begin;
      std::reverse(nodes + 1, nodes + front.nodes[g].count);
    });
    body.evaluate<Observe::kNo>();
    body.for_nodes([&](uint16_t n) { ASSERT_EQ(body.node().force[n], before[n]); });
  }
}

/// The mean gradient, which rotations are extracted from, against doubles: strain's rounding, and the
/// frame's.
TEST(GroupForces, ObserveTheVolumeMeanOfTheGradient) {
  Random random(77);
  double worst_lsb = 0.0;
  for (uint32_t round = 0; round < rounds(); ++round) {
    Body body = random_body<GroupsProfile>(random);
    deform_at_random(body, random, 0.7);
    if (body.evaluate() != 0) continue;
    const reference::Mesh mesh = reference::mesh_of(body.forest(), 1.0);
    const reference::Positions x = reference::positions_of(body.forest(), 1.0);
    body.for_groups([&](uint16_t g) {
      Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
      double volume = 0.0;
      for (uint32_t k = 0; k < body.front().leaves[g].count; ++k) {
        const reference::Element element =
            reference::element_of(mesh, body.front().leaf_order[body.front().leaves[g].begin + k]);
        mean += element.volume * reference::deformation_gradient(element, x);
        volume += element.volume;
      }
      worst_lsb = std::max(
          worst_lsb, std::ldexp((doubles(body.groups->gradient[g]) - mean / volume).cwiseAbs().maxCoeff(),
                                Stretch::kFractionBits));
    });
  }
  std::printf("mean gradient: off by at most %.1f LSB of 2^-26\n", worst_lsb);
  EXPECT_LE(worst_lsb, 40.0);
}

}  // namespace
}  // namespace palpate::test
