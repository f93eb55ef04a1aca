// Closest points, normals, directions and quotients against doubles, for triangles of any shape, flattened
// ones too.
#include "palpate/touch/triangle.hpp"

#include <gtest/gtest.h>

#include "support/soak.hpp"
#include "support/surfaces.hpp"

namespace palpate::test {
namespace {

using Eigen::Vector3d;

constexpr double kLsb = 1.0 / (1 << Position::kFractionBits);

struct TriangleCase {
  std::array<Vector3<Position>, 3> x;
  Vector3<Position> p;

  [[nodiscard]] std::array<Vector3d, 3> exact() const {
    return {doubles(x[0]), doubles(x[1]), doubles(x[2])};
  }
  /// The least of a triangle's heights.
  [[nodiscard]] double height() const {
    const auto [a, b, c] = exact();
    const double longest = std::max({(b - a).norm(), (c - a).norm(), (c - b).norm()});
    return longest > 0.0 ? (b - a).cross(c - a).norm() / longest : 0.0;
  }
  [[nodiscard]] double size() const {
    const auto [a, b, c] = exact();
    return std::max({(b - a).norm(), (c - a).norm(), (c - b).norm()});
  }
};

/// `size` edges large, its third corner `flatness` of that from the line of the others.
TriangleCase random_case(Random& random, double size, double flatness) {
  const Vector3d a = random.vector();
  const Vector3d along = size * random.vector();
  const Vector3d off = flatness * size * random.vector();
  const Vector3d c = a + random.centred() * 1.5 * along + off;
  Vector3d p = a + 3.0 * size * random.unit() * random.vector();
  if (random.below(2) == 0) {  // above or below it, near an edge of it
    p = a + 0.7 * random.unit() * along + 0.7 * random.unit() * (c - a);
    p += size * random.centred() * along.cross(c - a).normalized();
  }
  return TriangleCase{
      {fixed_vector<Position>(a), fixed_vector<Position>(Vector3d(a + along)), fixed_vector<Position>(c)},
      fixed_vector<Position>(p)};
}

TEST(TouchTriangle, FindsTheClosestPoint) {
  Random random(301);
  double worst = 0.0;
  double worst_thin = 0.0;
  uint32_t inner = 0;
  const uint32_t rounds = in_soak(20000000u, 200000u);
  for (uint32_t i = 0; i < rounds; ++i) {
    const double size = std::exp2(-11.0 * random.unit());
    const TriangleCase c = random_case(random, size, std::exp2(-12.0 * random.unit()));
    const TrianglePoint found = closest_on_triangle(c.x[0], c.x[1], c.x[2], c.p);
    const double distance = (doubles(c.p) - doubles(found.point)).norm();
    const double error = std::abs(distance - distance_to_triangle(c.exact(), doubles(c.p)));
    inner += found.is_inner ? 1u : 0u;
    const double thinness = c.size() > 0.0 ? c.height() / c.size() : 0.0;
    if (thinness > 1.0 / 32.0 && size > 1.0 / 4096.0) {
      worst = std::max(worst, error);
    } else {
      worst_thin = std::max(worst_thin, error - std::min(c.height(), c.size() / 256.0));
    }
    ASSERT_LE(found.point[0].raw(), Position::ratio(5, 1).raw());
  }
  std::printf(
      "%u closest points, %u inner: worst distance %.1f LSB, beyond its height in thin ones %.1f LSB\n",
      rounds, inner, worst / kLsb, worst_thin / kLsb);
  EXPECT_LE(worst, 4.0 * kLsb);
  EXPECT_LE(worst_thin, 4.0 * kLsb);
  EXPECT_GT(inner, rounds / 20);
}

TEST(TouchTriangle, WeightsAreWholeAndGiveThePoint) {
  Random random(302);
  for (uint32_t i = 0; i < in_soak(5000000u, 50000u); ++i) {
    const TriangleCase c = random_case(random, std::exp2(-9.0 * random.unit()), random.unit());
    const TrianglePoint found = closest_on_triangle(c.x[0], c.x[1], c.x[2], c.p);
    int64_t sum = 0;
    Vector3d mean = Vector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_GE(found.weight[k].raw(), 0);
      sum += found.weight[k].raw();
      mean += sim::to_double(found.weight[k]) * doubles(c.x[k]);
    }
    ASSERT_EQ(sum, int64_t{1} << 30);
    ASSERT_LE((mean - doubles(found.point)).cwiseAbs().maxCoeff(), 1.0 * kLsb);
  }
}

/// A point that is a corner, or on an edge, is its own closest point; so is a triangle that is one point.
TEST(TouchTriangle, IsExactAtCornersAndForPoints) {
  Random random(303);
  for (int i = 0; i < 3000; ++i) {
    const TriangleCase c = random_case(random, 0.5, 0.5);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(closest_on_triangle(c.x[0], c.x[1], c.x[2], c.x[k]).point, c.x[k]);
    }
    EXPECT_EQ(closest_on_triangle(c.x[0], c.x[0], c.x[0], c.p).point, c.x[0]);
    const double line = distance_to_segment(doubles(c.x[0]), doubles(c.x[1]), doubles(c.p));
    const TrianglePoint flat = closest_on_triangle(c.x[0], c.x[1], c.x[1], c.p);
    EXPECT_NEAR((doubles(c.p) - doubles(flat.point)).norm(), line, 4 * kLsb);
    EXPECT_EQ(triangle_normal(c.x[0], c.x[1], c.x[1]), zero_vector<Fraction>());
  }
}

TEST(TouchTriangle, NormalsAreUnitVectorsAcross) {
  Random random(304);
  for (uint32_t i = 0; i < in_soak(5000000u, 50000u); ++i) {
    const TriangleCase c =
        random_case(random, std::exp2(-9.0 * random.unit()), std::exp2(-4.0 * random.unit()));
    if (c.height() < 1e-5) continue;
    const auto [a, b, d] = c.exact();
    const Vector3d expected = (b - a).cross(d - a).normalized();
    const Vector3d n = doubles(triangle_normal(c.x[0], c.x[1], c.x[2]));
    ASSERT_NEAR(n.norm(), 1.0, 1e-8);
    ASSERT_LE((n - expected).norm(), 1e-8);  // of the rounded vertices it is exact
  }
}

TEST(TouchTriangle, DirectionsAndQuotientsAreExactAtEverySize) {
  Random random(305);
  double direction_error = 0.0;
  double quotient_error = 0.0;
  for (uint32_t i = 0; i < in_soak(5000000u, 50000u); ++i) {
    const double size = 7.9 * std::exp2(-20.0 * random.unit());
    const auto v = fixed_vector<Position>(Vector3d(size * random.vector()));
    if (v == zero_vector<Position>()) continue;
    direction_error = std::max(direction_error, (doubles(direction_of(v)) - doubles(v).normalized()).norm());
    const int32_t whole = 1 + static_cast<int32_t>(random.below(1u << 30));
    const auto part = static_cast<int32_t>(random.below(static_cast<uint32_t>(whole) + 1u));
    const double of_words = sim::to_double(fraction_of(part, whole)) - static_cast<double>(part) / whole;
    quotient_error = std::max(quotient_error, std::abs(of_words));
    EXPECT_NEAR(sim::to_double(component_along(v, direction_of(v))), doubles(v).norm(), 16 * kLsb);
    const auto denominator = static_cast<int64_t>(std::exp2(62.0 * random.unit()));
    const auto numerator = static_cast<int64_t>(random.unit() * static_cast<double>(denominator));
    const double quotient = static_cast<double>(numerator) / static_cast<double>(denominator);
    quotient_error =
        std::max(quotient_error, std::abs(sim::to_double(fraction_of(numerator, denominator)) - quotient));
  }
  std::printf("directions within %.1f LSB, quotients within %.1f LSB of 2^-30\n",
              std::ldexp(direction_error, 30), std::ldexp(quotient_error, 30));
  EXPECT_LE(std::ldexp(direction_error, 30), 4.0);
  EXPECT_LE(std::ldexp(quotient_error, 30), 4.0);
  EXPECT_EQ(fraction_of(1 << 30, 1 << 30), kFullFraction);
  EXPECT_EQ(fraction_of(int64_t{1} << 62, int64_t{1} << 62), kFullFraction);
  EXPECT_EQ(fraction_of(int64_t{-1}, int64_t{5}).raw(), 0);
  EXPECT_EQ(fraction_of(int64_t{5}, int64_t{0}).raw(), 0);
  EXPECT_EQ(fraction_of(int64_t{6}, int64_t{5}), kFullFraction);
  EXPECT_EQ(fraction_of(-1, 5).raw(), 0);
  EXPECT_EQ(fraction_of(0, 0).raw(), 0);
  EXPECT_EQ(fraction_of(5, 5), kFullFraction);
  EXPECT_EQ(fraction_of(1, 2), Fraction::ratio(1, 2));
  EXPECT_EQ(direction_of(zero_vector<Position>()), zero_vector<Fraction>());
}

/// Corners of the domain: all that the formats must take. The checked build stops where one does not.
TEST(TouchTriangle, TakesTheFarthestPoints) {
  std::vector<Vector3<Position>> corners;
  for (int i = 0; i < 27; ++i) {
    const auto coordinate = [](int which) {
      return which == 0 ? -Position::ratio(5, 1) : which == 1 ? Position::from_raw(0) : Position::ratio(5, 1);
    };
    corners.emplace_back(coordinate(i % 3), coordinate(i / 3 % 3), coordinate(i / 9));
  }
  Random random(306);
  const auto any = [&] { return corners[random.below(27)]; };
  for (int i = 0; i < 20000; ++i) {
    const TriangleCase c{{any(), any(), any()}, any()};
    const TrianglePoint found = closest_on_triangle(c.x[0], c.x[1], c.x[2], c.p);
    const double distance = (doubles(c.p) - doubles(found.point)).norm();
    ASSERT_NEAR(distance, distance_to_triangle(c.exact(), doubles(c.p)), 32 * kLsb);
    const Vector3d n = doubles(triangle_normal(c.x[0], c.x[1], c.x[2]));
    ASSERT_TRUE(n.norm() == 0.0 || std::abs(n.norm() - 1.0) < 1e-8);
  }
}

}  // namespace
}  // namespace palpate::test
