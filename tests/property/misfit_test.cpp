// The misfit of a group against its definition in doubles.
#include "palpate/elastic/misfit.hpp"

#include <gtest/gtest.h>

#include "support/elastic_bodies.hpp"
#include "support/soak.hpp"

namespace palpate::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using GroupsProfile = TestProfile<500, 300, 9>;
using Body = ElasticBody<GroupsProfile>;

/// One leaf as a group sees it.
struct Seen {
  Matrix3d a;  // R^T F
  uint32_t path, depth;
};

struct Exact {
  double misfit, left;
};

/// The header's formula: w of each leaf, its sums over the grandchildren of the group's tet, in root volumes.
Exact misfit_of(const std::vector<Seen>& leaves, uint32_t level) {
  const double whole = std::ldexp(1.0, -static_cast<int>(level));
  Vector3d sum[4] = {Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
  double s = 0.0;
  for (const Seen& leaf : leaves) {
    if (leaf.depth == 0) continue;
    const double volume = std::ldexp(whole, -static_cast<int>(leaf.depth));
    const Matrix3d& a = leaf.a;
    const Vector3d w = 0.5 * Vector3d(a(2, 1) - a(1, 2), a(0, 2) - a(2, 0), a(1, 0) - a(0, 1));
    s += volume * w.squaredNorm();
    const std::size_t child = (leaf.path >> (leaf.depth - 1)) & 1u;
    if (leaf.depth == 1) {
      sum[2 * child] += 0.5 * volume * w;
      sum[2 * child + 1] += 0.5 * volume * w;
    } else {
      sum[2 * child + ((leaf.path >> (leaf.depth - 2)) & 1u)] += volume * w;
    }
  }
  const double d0 = (sum[0] + sum[1] - sum[2] - sum[3]).squaredNorm() / whole;
  const double halves = ((sum[0] - sum[1]).squaredNorm() + (sum[2] - sum[3]).squaredNorm()) / (whole / 2);
  return Exact{4.0 * (d0 + 0.25 * halves + s / 32.0), 4.0 * (0.25 * d0 + s / 32.0)};
}

std::vector<Seen> leaves_of(Body& body, uint16_t group, const reference::Mesh& mesh,
                            const reference::Positions& x) {
  std::vector<Seen> seen;
  const Matrix3d r = doubles(rotation_matrix(body.groups->used[group]));
  const uint8_t level = body.forest().level_of(body.front().tet[group]);
  for (uint32_t k = 0; k < body.front().leaves[group].count; ++k) {
    const uint32_t index = body.front().leaf_order[body.front().leaves[group].begin + k];
    const reference::Element element = reference::element_of(mesh, index);
    const Leaf& leaf = body.forest().leaf[index];
    seen.push_back({r.transpose() * reference::deformation_gradient(element, x), leaf.path(),
                    static_cast<uint32_t>(leaf.level() - level)});
  }
  return seen;
}

/// Strains are off by some 2^-25, and the misfit is cut to 2^-32.
double tolerance(double misfit) { return std::ldexp(2.0, -32) + std::ldexp(std::sqrt(misfit), -23); }

TEST(Misfit, IsItsFormula) {
  Random random(81);
  uint32_t compared = 0;
  double worst = 0.0;
  for (uint32_t round = 0; round < in_soak(5000u, 200u); ++round) {
    Body body = random_body<GroupsProfile>(random, 50 + 3 * round % 400);
    deform_at_random(body, random, random.unit());
    if (body.evaluate() != 0) continue;
    const reference::Mesh mesh = reference::mesh_of(body.forest(), 1.0);
    const reference::Positions x = reference::positions_of(body.forest(), 1.0);
    body.for_groups([&](uint16_t g) {
      const uint8_t level = body.forest().level_of(body.front().tet[g]);
      const Exact exact = misfit_of(leaves_of(body, g, mesh, x), level);
      if (exact.misfit > 0.49) return;
      ++compared;
      const double error = std::max(std::abs(sim::to_double(body.groups->misfit[g]) - exact.misfit),
                                    std::abs(sim::to_double(body.groups->misfit_left[g]) - exact.left));
      worst = std::max(worst, error / tolerance(exact.misfit));
    });
  }
  std::printf("%u groups: off by at most %.2f of the tolerance\n", compared, worst);
  EXPECT_GT(compared, 1000u);
  EXPECT_LE(worst, 1.0);
}

/// A slice of it in every tick: after kMisfitSlices, or twice as many, all misfits are those of now. A group
/// whose leaves change in the middle of its turn is begun anew.
TEST(Misfit, IsRenewedInSlices) {
  Random random(85);
  uint32_t rounds_with_change = 0;
  for (int round = 0; round < 30; ++round) {
    Body body = random_body<GroupsProfile>(random);
    deform_at_random(body, random, 0.5);
    MisfitSweep sweep{};
    sweep.clear();
    for (uint32_t i = 0; i < random.below(kMisfitSlices); ++i) {
      renew_misfits(body.forest(), body.front(), *body.groups, sweep);
    }
    rounds_with_change += sweep.leaf_at > 0 ? 1u : 0u;
    deform_at_random(body, random, 0.5);
    sweep.resume(kNone, 0);  // as if all of the group's leaves were others
    for (uint32_t i = 0; i < 2 * kMisfitSlices; ++i) {
      renew_misfits(body.forest(), body.front(), *body.groups, sweep);
    }
    const Groups<GroupsProfile> renewed = *body.groups;
    renew_all_misfits(body.forest(), body.front(), *body.groups);
    body.for_groups([&](uint16_t g) {
      ASSERT_EQ(renewed.misfit[g], body.groups->misfit[g]);
      ASSERT_EQ(renewed.misfit_left[g], body.groups->misfit_left[g]);
    });
  }
  EXPECT_GT(rounds_with_change, 5u);
}

/// A leaf has nothing to gain from a split.
TEST(Misfit, OfASingleLeafIsZero) {
  Random random(82);
  uint32_t leaves = 0;
  for (int round = 0; round < 50; ++round) {
    Body body = random_body<GroupsProfile>(random);
    deform_at_random(body, random, 1.0);
    (void)body.evaluate();
    body.for_groups([&](uint16_t g) {
      if (!body.forest().tet[body.front().tet[g]].is_leaf()) return;
      ++leaves;
      EXPECT_EQ(body.groups->misfit[g].raw(), 0);
      EXPECT_EQ(body.groups->misfit_left[g].raw(), 0);
    });
  }
  EXPECT_GT(leaves, 100u);
}

/// Turned alike, no leaf is turned wrongly: strains of rounding (2^-24) have squares far below the format's
/// LSB.
TEST(Misfit, OfARigidMotionIsZero) {
  Random random(83);
  for (int round = 0; round < 50; ++round) {
    Body body = random_body<GroupsProfile>(random);
    const Matrix3d r = random.rotation();
    const Vector3d shift = random.vector();
    body.place([&](const Vector3d& x0) { return Vector3d(r * x0 + shift); });
    body.for_groups([&](uint16_t g) { body.groups->used[g] = fixed_quaternion(r); });
    ASSERT_EQ(body.evaluate(), 0u);
    body.for_groups([&](uint16_t g) { ASSERT_EQ(body.groups->misfit[g].raw(), 0); });
  }
}

/// Nor is a symmetric strain a rotation.
TEST(Misfit, OfAPureStretchIsZero) {
  Random random(84);
  for (int round = 0; round < 50; ++round) {
    Body body = random_body<GroupsProfile>(random);
    const Matrix3d q = random.rotation();
    const Matrix3d stretch = q * random.between(0.95, 1.05).asDiagonal() * q.transpose();
    body.place([&](const Vector3d& x0) { return Vector3d(stretch * x0); });
    ASSERT_EQ(body.evaluate(), 0u);
    body.for_groups([&](uint16_t g) { ASSERT_EQ(body.groups->misfit[g].raw(), 0); });
  }
}

TEST(Misfit, SaturatesBeyondOneHalf) {
  const auto turned = fixed_vector<Strain>(Vector3d(0, 0, 2));  // by a right angle
  const Vector3<Strain> back = -turned;
  MisfitSums sums;
  sums.clear();
  sums.add(turned, 0, 1);
  sums.add(back, 1, 1);
  Misfit misfit{};
  Misfit left{};
  sums.finish(0, misfit, left);
  EXPECT_EQ(misfit, Misfit::max());
  EXPECT_EQ(joined_misfit(Q<4, 27>::ratio(8, 1), Misfit::max(), Misfit::max(), 0), Misfit::max());
}

/// The leaves of two sibling groups, turned by small angles about their groups' rotations, which are `apart`
/// from one another: what each group leaves, and what both have as one under the rotation in the middle.
struct Siblings {
  Exact parts[2];
  Exact whole;
  double square;  // |R_1 - R_2|_F^2
};

Siblings random_siblings(Random& random, double apart, double within, uint32_t level) {
  const Vector3d axis = random.direction();
  std::vector<Seen> whole;
  Siblings siblings{};
  for (uint32_t child = 0; child < 2; ++child) {
    const Matrix3d own = Eigen::AngleAxisd((child == 0 ? 0.5 : -0.5) * apart, axis).toRotationMatrix();
    std::vector<Seen> part;
    // Four leaves two levels below the child, with turns that add up to nothing, as the mean rotation has it.
    const Vector3d of_half = within * random.vector();
    const Vector3d of_quarter[2] = {within * random.vector(), within * random.vector()};
    for (uint32_t k = 0; k < 4; ++k) {
      const Vector3d turn = (k < 2 ? 1.0 : -1.0) * of_half + (k % 2 == 0 ? 1.0 : -1.0) * of_quarter[k / 2];
      const Matrix3d a = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
      part.push_back({a, k, 2});
      whole.push_back({own * a, 4 * child + k, 3});
    }
    siblings.parts[child] = misfit_of(part, level + 1);
  }
  siblings.whole = misfit_of(whole, level);
  siblings.square = 4.0 * (1.0 - std::cos(apart));
  return siblings;
}

/// To second order in the angles: sin and angle, and turns about other axes.
TEST(JoinedMisfit, IsWhatTheParentWouldHave) {
  Random random(85);
  double worst = 0.0;
  for (uint32_t round = 0; round < in_soak(1000000u, 20000u); ++round) {
    const uint32_t level = random.below(6);
    const Siblings s = random_siblings(random, 0.1 * random.unit(), 0.05 * random.unit(), level);
    const auto fixed = [](double value) { return sim::to_fixed<Misfit>(value); };
    const Misfit joined = joined_misfit(sim::to_fixed<Q<4, 27>>(s.square), fixed(s.parts[0].left),
                                        fixed(s.parts[1].left), level);
    worst = std::max(worst, std::abs(sim::to_double(joined) - s.whole.misfit) /
                                (0.01 * s.whole.misfit + std::ldexp(40.0, -32)));
  }
  std::printf("joined misfit: off by at most %.2f %% of the parent's\n", worst);
  EXPECT_LE(worst, 1.0);
}

}  // namespace
}  // namespace palpate::test
