// Quaternions against doubles: norms, what lies between two rotations, and how far apart they are.
#include "palpate/numeric/rotation.hpp"

#include <gtest/gtest.h>

#include "support/fixed.hpp"
#include "support/random.hpp"
#include "support/soak.hpp"

namespace palpate::test {
namespace {

using Eigen::Vector4d;

uint32_t count() { return in_soak(5000000u, 50000u); }

/// w, x, y, z.
Vector4d entries(const Quaternion& q) {
  return Vector4d(sim::to_double(q.w), sim::to_double(q.x), sim::to_double(q.y), sim::to_double(q.z));
}

Quaternion fixed_of(const Vector4d& v) {
  const auto entry = [](double value) { return sim::to_fixed<RotationEntry>(value); };
  return Quaternion{entry(v[0]), entry(v[1]), entry(v[2]), entry(v[3])};
}

Vector4d random_unit(Random& random) {
  Vector4d v;
  do {
    for (int i = 0; i < 4; ++i) v[i] = random.centred();
  } while (v.norm() < 0.1 || v.norm() > 1.0);
  return v.normalized();
}

double in_lsb(double error) { return std::ldexp(error, RotationEntry::kFractionBits); }

TEST(NumericRotation, NormalisedIsWithinOneLsb) {
  Random random(41);
  double worst = 0.0;
  for (uint32_t i = 0; i < count(); ++i) {
    const double length = std::sqrt(0.5 + 1.499 * random.unit());
    Quaternion q = fixed_of(length * random_unit(random));
    const Vector4d exact = entries(q).normalized();
    normalise(q);
    worst = std::max(worst, in_lsb((entries(q) - exact).cwiseAbs().maxCoeff()));
  }
  std::printf("normalise: off by at most %.2f LSB\n", worst);
  EXPECT_LE(worst, 1.0);
}

/// One LSB from normalise, and up to one each from four differences, up to sqrt(2) longer by the norm.
constexpr double kBetweenLsb = 2.5;

Quaternion between(Quaternion from, const Quaternion& to, RotationEntry fraction) {
  approach(from, to, fraction);
  return from;
}

double between_error(const Quaternion& from, const Quaternion& to, RotationEntry fraction) {
  const Vector4d a = entries(from);
  const Vector4d b = a.dot(entries(to)) < 0 ? Vector4d(-entries(to)) : entries(to);
  const Vector4d exact = (a + sim::to_double(fraction) * (b - a)).normalized();
  return in_lsb((entries(between(from, to, fraction)) - exact).cwiseAbs().maxCoeff());
}

TEST(NumericRotation, BetweenIsTheNormalisedMixture) {
  Random random(42);
  double worst = 0.0;
  for (uint32_t i = 0; i < count(); ++i) {
    const Quaternion from = fixed_of(random_unit(random));
    const Quaternion to = fixed_of(random_unit(random));
    worst = std::max(worst, between_error(from, to, sim::to_fixed<RotationEntry>(random.unit())));
  }
  std::printf("approach: off by at most %.2f LSB\n", worst);
  EXPECT_LE(worst, kBetweenLsb);
}

/// Half a turn apart, halfway: the mixture is as short as it can be, |q|^2 = 1/2.
TEST(NumericRotation, BetweenRotationsHalfATurnApart) {
  Random random(43);
  double worst = 0.0;
  for (uint32_t i = 0; i < count() / 10; ++i) {
    const Vector4d a = random_unit(random);
    Vector4d b = random_unit(random);
    b = (b - b.dot(a) * a).normalized();
    const Quaternion middle = between(fixed_of(a), fixed_of(b), RotationEntry::ratio(1, 2));
    ASSERT_LE(norm_error(middle), 8.0);
    // Rounded to the format the two may be on either side of orthogonal, and then b's sign is open.
    const Vector4d half = std::sqrt(0.5) * a;
    const Vector4d other = std::sqrt(0.5) * b;
    worst = std::max(worst, in_lsb(std::min((entries(middle) - half - other).cwiseAbs().maxCoeff(),
                                            (entries(middle) - half + other).cwiseAbs().maxCoeff())));
  }
  EXPECT_LE(worst, kBetweenLsb + 2.0);
}

TEST(NumericRotation, BetweenEndsWhereItShouldAndGoesTheShortWay) {
  Random random(44);
  for (int i = 0; i < 1000; ++i) {
    const Quaternion from = fixed_of(random_unit(random));
    const Quaternion to = fixed_of(random_unit(random));
    const Quaternion end = between(from, to, RotationEntry::ratio(1, 1));
    const double sign = entries(from).dot(entries(to)) < 0 ? -1.0 : 1.0;
    ASSERT_EQ(entries(end), Vector4d(sign * entries(to)));
    const Quaternion start = between(from, to, RotationEntry::from_raw(0));
    ASSERT_LE(in_lsb((entries(start) - entries(from)).cwiseAbs().maxCoeff()), 4.0);
    const Quaternion still = between(to, to, RotationEntry::ratio(1, 3));
    ASSERT_LE(in_lsb((entries(still) - entries(to)).cwiseAbs().maxCoeff()), 4.0);
    const Quaternion middle = between(from, to, RotationEntry::ratio(1, 2));
    ASSERT_GE(std::abs(entries(middle).dot(entries(from))), std::sqrt(0.5) - 1e-6);
  }
}

TEST(NumericRotation, MatrixIsWithinOneLsb) {
  Random random(47);
  double worst = 0.0;
  for (uint32_t i = 0; i < count(); ++i) {
    const Quaternion q = fixed_of(random_unit(random));
    const Eigen::Quaterniond exact = doubles(q);
    // Not normalised: the formula's own entries.
    worst = std::max(worst,
                     in_lsb((doubles(rotation_matrix(q)) - exact.toRotationMatrix()).cwiseAbs().maxCoeff()));
  }
  std::printf("rotation matrix: off by at most %.2f LSB\n", worst);
  EXPECT_LE(worst, 0.6);
}

TEST(NumericRotation, MatrixOfTurnsByHalfIsExact) {
  const RotationEntry zero = RotationEntry::from_raw(0);
  const RotationEntry one = RotationEntry::ratio(1, 1);
  for (const RotationEntry x : {one, -one}) {
    const RotationMatrix r = rotation_matrix(Quaternion{zero, x, zero, zero});
    EXPECT_EQ(doubles(r), Eigen::Matrix3d(Eigen::Vector3d(1, -1, -1).asDiagonal()));
  }
}

TEST(NumericRotation, SquareOfDifferenceIsWithinFourLsb) {
  Random random(45);
  double worst = 0.0;
  for (uint32_t i = 0; i < count(); ++i) {
    const Eigen::Matrix3d r = random.rotation();
    const double angle = std::pow(random.unit(), 3) * 3.14159;
    const Quaternion a = fixed_quaternion(r);
    const Quaternion b =
        fixed_quaternion(r * Eigen::AngleAxisd(angle, random.direction()).toRotationMatrix());
    const Eigen::Matrix3d difference =
        doubles(a).normalized().toRotationMatrix() - doubles(b).normalized().toRotationMatrix();
    const double error = sim::to_double(square_of_difference(a, b)) - difference.squaredNorm();
    worst = std::max(worst, std::abs(std::ldexp(error, 27)));
    EXPECT_NEAR(difference.squaredNorm(), 4.0 * (1.0 - std::cos(angle)), 1e-7);
  }
  std::printf("square of difference: off by at most %.2f LSB of 2^-27\n", worst);
  EXPECT_LE(worst, 4.0);
}

TEST(NumericRotation, ARotationDoesNotDifferFromItselfOrItsNegative) {
  Random random(46);
  for (int i = 0; i < 1000; ++i) {
    const Quaternion q = fixed_of(random_unit(random));
    EXPECT_EQ(square_of_difference(q, q).raw(), 0);
    EXPECT_EQ(square_of_difference(q, Quaternion{-q.w, -q.x, -q.y, -q.z}).raw(), 0);
  }
}

}  // namespace
}  // namespace palpate::test
