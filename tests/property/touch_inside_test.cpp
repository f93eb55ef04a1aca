// Whether a point is in a body that bends and changes, against barycentric coordinates in doubles.
#include "palpate/touch/inside.hpp"

#include <gtest/gtest.h>

#include "palpate/touch/contact.hpp"
#include "support/surfaces.hpp"

namespace palpate::test {
namespace {

using Eigen::Vector3d;

struct InsideProfile : Bar {
  static constexpr uint16_t kLeaves = 600;
  static constexpr uint32_t kContactCandidates = 64;
};

/// Least barycentric coordinate of p in a tet, the highest of all tets: positive inside, negative outside.
double depth_in_body(const Forest<InsideProfile>& forest, const Vector3d& p) {
  double deepest = -1e9;
  for (uint32_t i = 0; i < forest.leaf_count; ++i) {
    const auto at = [&](std::size_t k) { return doubles(forest.node.position[forest.leaf[i].node[k]]); };
    Eigen::Matrix3d edges;
    edges << at(1) - at(0), at(2) - at(0), at(3) - at(0);
    const Vector3d b = edges.fullPivLu().solve(Vector3d(p - at(0)));
    deepest = std::max(deepest, std::min({b[0], b[1], b[2], 1.0 - b.sum()}));
  }
  return deepest;
}

void stir(Random& random, Forest<InsideProfile>& forest) {
  for (uint32_t i = 0; i < forest.nodes.used(); ++i) {
    auto& x = forest.node.position[forest.nodes.live(i)];
    x = fixed_vector<Position>(doubles(x) + 0.05 * random.vector());
  }
}

TEST(TouchInside, IsWhatBarycentricCoordinatesSay) {
  Random random(351);
  const auto sides = std::make_unique<Sides<InsideProfile>>();
  uint32_t inside = 0;
  uint32_t outside = 0;
  for (int round = 0; round < 20; ++round) {
    const auto forest = changed_forest<InsideProfile>(random, 20);
    stir(random, *forest);
    for (int i = 0; i < 200; ++i) {
      const Vector3d p = doubles(fixed_vector<Position>(2.0 * random.vector()));
      const double depth = depth_in_body(*forest, p);
      if (std::abs(depth) < 1e-3) continue;
      ASSERT_EQ(is_inside(*forest, fixed_vector<Position>(p), *sides), depth > 0.0) << depth;
      inside += depth > 0.0 ? 1u : 0u;
      outside += depth < 0.0 ? 1u : 0u;
    }
  }
  EXPECT_GT(inside, 500u);
  EXPECT_GT(outside, 500u);
}

/// An inverted tet holds its points like any other.
TEST(TouchInside, HoldsForInvertedTets) {
  using Offset = inside_detail::Offset;
  const std::array<Offset, 4> tet = {Offset{-10, -10, -10}, Offset{40, 0, 0}, Offset{0, 40, 0},
                                     Offset{0, 0, 40}};
  const std::array<Offset, 4> inverted = {tet[1], tet[0], tet[2], tet[3]};
  EXPECT_TRUE(inside_detail::is_in_tet(tet));
  EXPECT_TRUE(inside_detail::is_in_tet(inverted));
  const std::array<Offset, 4> beside = {Offset{1, 1, 1}, Offset{40, 0, 0}, Offset{0, 40, 0},
                                        Offset{0, 0, 40}};
  EXPECT_FALSE(inside_detail::is_in_tet(beside));
}

/// A tool that appears in the body or in its skin touches nothing until it has come out of it.
TEST(TouchInside, AToolThatAppearsInsideBeginsToTouchOutside) {
  Random random(352);
  const auto forest = changed_forest<InsideProfile>(random, 0);
  ContactRules rules{};
  rules.radius = Position::ratio(1, 8);
  rules.stiffness = Coupling::ratio(8, 1);
  rules.force_limit = rules.slew = Force::ratio(1, 1);
  Candidates<InsideProfile> candidates{};
  Contact contact{};
  contact.clear();
  // From the middle of the block out through its top at z = 1, to 0.2 above it, and down again.
  for (int i = 0; i <= 120; ++i) {
    const double z = 0.01 * i;
    ContactStep<InsideProfile>(*forest, rules, candidates, contact)
        .run(fixed_vector<Position>(Vector3d(1.0, -0.4, z)));
    ASSERT_EQ(contact.is_present, z >= 1.125) << z;
    ASSERT_EQ(contact.force, zero_vector<Force>());
  }
  for (int i = 120; i >= 105; --i) {
    ContactStep<InsideProfile>(*forest, rules, candidates, contact)
        .run(fixed_vector<Position>(Vector3d(1.0, -0.4, 0.01 * i)));
  }
  EXPECT_TRUE(contact.is_touching);
  EXPECT_GT(contact.force[2].raw(), 0);
}

}  // namespace
}  // namespace palpate::test
