// One fixed-point extraction step against singular values, from warm starts that are off by a known angle.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <vector>

#include "any_seed.hpp"
#include "reference/polar_rotation.hpp"
#include "support/fixed.hpp"
#include "support/random.hpp"
#include "support/soak.hpp"

namespace palpate::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kDegrees = 57.29577951308232;

Matrix3d rotated_by(Random& random, double degrees) {
  return Eigen::AngleAxisd(degrees / kDegrees, random.direction()).toRotationMatrix();
}

/// R Q diag(stretches) Q^T with random R and Q, and a warm start that is `off` degrees from R.
struct Case {
  DeformationGradient f;
  Matrix3d exact;
  Quaternion warm;
};

Case make_case(Random& random, const Vector3d& stretches, double off_degrees) {
  const Matrix3d q = random.rotation();
  const Matrix3d f = random.rotation() * q * stretches.asDiagonal() * q.transpose();
  Case made{fixed_matrix<Stretch>(f), Matrix3d(), Quaternion{}};
  made.exact = reference::polar_rotation(doubles(made.f));
  made.warm = fixed_quaternion(made.exact * rotated_by(random, off_degrees));
  return made;
}

double error_degrees(const Matrix3d& exact, const Quaternion& q) {
  return reference::angle_between(exact, doubles(q).normalized().toRotationMatrix()) * kDegrees;
}

struct Errors {
  double median, most;
};

/// Errors after `steps` extractions, over many cases.
Errors measure(uint64_t seed, double off_degrees, int steps, Vector3d (*stretches)(Random&)) {
  Random random(seed);
  std::vector<double> errors;
  for (uint32_t i = 0; i < in_soak(1000000u, 20000u); ++i) {
    const Case c = make_case(random, stretches(random), off_degrees);
    Quaternion q = c.warm;
    for (int step = 0; step < steps; ++step) extract_rotation(c.f, q);
    EXPECT_LE(norm_error(q), 8.0);
    errors.push_back(error_degrees(c.exact, q));
  }
  std::sort(errors.begin(), errors.end());
  const Errors result{errors[errors.size() / 2], errors.back()};
  std::printf("off %.0f deg, %d step(s): median %.2g, max %.2g deg\n", off_degrees, steps, result.median,
              result.most);
  return result;
}

Vector3d tissue_stretches(Random& random) {  // as seen in strong bending
  return random.between(0.55, 1.8);
}
Vector3d inverted_stretches(Random& random) {
  Vector3d stretches = random.between(0.7, 1.7);
  stretches[2] = -0.3 * random.unit();
  return stretches;
}

struct Bound {
  const char* name;
  uint64_t seed;
  double off_degrees;
  int steps;
  Vector3d (*stretches)(Random&);
  double median_degrees, most_degrees;
};

std::ostream& operator<<(std::ostream& stream, const Bound& bound) { return stream << bound.name; }

class RotationExtractionError : public testing::TestWithParam<Bound> {};

TEST_P(RotationExtractionError, IsBelowItsBound) {
  const Bound& bound = GetParam();
  const Errors errors = measure(bound.seed, bound.off_degrees, bound.steps, bound.stretches);
  EXPECT_LT(errors.median, bound.median_degrees);
  EXPECT_LT(errors.most, bound.most_degrees);
}

constexpr Bound kBounds[] = {
    {"OneStepFromOneDegree", 21, 1.0, 1, tissue_stretches, 9.6e-5, 1.2e-4},
    {"OneStepFromFiveDegrees", 22, 5.0, 1, tissue_stretches, 0.012, 0.015},
    {"TwoStepsReachTheFormat", 23, 5.0, 2, tissue_stretches, 2e-6, 8e-6},
    {"OneStepOfAnInvertedTet", 24, 5.0, 1, inverted_stretches, 0.014, 0.065},
    {"TwoStepsOfAnInvertedTet", 25, 5.0, 2, inverted_stretches, 5e-6, 6e-5},
    {"ConvergesFromFarOff", 26, 60.0, 8, tissue_stretches, 2e-6, 8e-6},
};

std::string name_of(const testing::TestParamInfo<Bound>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Steps, RotationExtractionError, testing::ValuesIn(kBounds), name_of);

bool is_unit_rotation(const Quaternion& q) {
  const Matrix3d r = doubles(rotation_matrix(q));
  const bool orthogonal =
      (r.transpose() * r - Matrix3d::Identity()).cwiseAbs().maxCoeff() < std::ldexp(16.0, -30);
  return norm_error(q) <= 8.0 && orthogonal && r.determinant() > 0.99;
}

/// Whatever F is within its format's use, and wherever the step starts.
RC_GTEST_PROP(RotationExtraction, StaysAUnitRotationForAnyGradient, ()) {
  Random random(any_seed());
  Matrix3d f;
  for (int i = 0; i < 9; ++i) f.data()[i] = 8.0 * random.centred();
  Quaternion q = fixed_quaternion(random.rotation());
  for (int step = 0; step < 5; ++step) {
    extract_rotation(fixed_matrix<Stretch>(f), q);
    RC_ASSERT(is_unit_rotation(q));
  }
}

/// Flat, thread-like, tiny and zero gradients of either orientation, where no unique rotation need exist.
RC_GTEST_PROP(RotationExtraction, StaysAUnitRotationForDegenerateGradients, ()) {
  Random random(any_seed());
  const double zeros[4] = {0.0, 1e-8, 1e-3, -1e-3};
  Vector3d s(*rc::gen::element(0.0, 1e-6, 1.0, 8.0), 0.0, 0.0);
  s[1] = zeros[random.below(4)];
  s[2] = zeros[random.below(4)];
  const Matrix3d q0 = random.rotation();
  const Matrix3d f = q0 * s.asDiagonal() * random.rotation();
  Quaternion q = fixed_quaternion(random.rotation());
  for (int step = 0; step < 20; ++step) {
    extract_rotation(fixed_matrix<Stretch>(f), q);
    RC_ASSERT(is_unit_rotation(q));
  }
}

/// Each step climbs tr(R^T F), or stays at its top but for rounding.
RC_GTEST_PROP(RotationExtraction, NeverDescends, ()) {
  Random random(any_seed());
  const Matrix3d q0 = random.rotation();
  const Vector3d stretches = tissue_stretches(random);
  const Matrix3d f = q0 * stretches.asDiagonal() * random.rotation();
  const DeformationGradient fixed = fixed_matrix<Stretch>(f);
  Quaternion q = fixed_quaternion(reference::polar_rotation(f) * rotated_by(random, 80.0 * random.unit()));
  const auto height = [&](const Quaternion& at) {
    return (doubles(at).normalized().toRotationMatrix().transpose() * doubles(fixed)).trace();
  };
  for (int step = 0; step < 6; ++step) {
    Quaternion next = q;
    extract_rotation(fixed, next);
    RC_ASSERT(height(next) > height(q) - 1e-7);
    q = next;
  }
}

TEST(RotationExtraction, ZeroGradientKeepsTheWarmStart) {
  Random random(27);
  const DeformationGradient zero = fixed_matrix<Stretch>(Matrix3d::Zero());
  for (int i = 0; i < 100; ++i) {
    const Quaternion warm = fixed_quaternion(random.rotation());
    Quaternion q = warm;
    extract_rotation(zero, q);
    EXPECT_LE((doubles(q).coeffs() - doubles(warm).coeffs()).cwiseAbs().maxCoeff(), std::ldexp(2.0, -30));
  }
}

/// A tet that turns and breathes for a long time: the norm never drifts, and the rotation follows.
TEST(RotationExtraction, FollowsForALongTime) {
  Random random(28);
  const Matrix3d q0 = random.rotation();
  const Vector3d axis = random.direction();
  Quaternion q = fixed_quaternion(Matrix3d::Identity());
  double worst_norm = 0.0;
  double worst_error = 0.0;
  for (uint32_t i = 0; i < in_soak(1000000u, 10000u); ++i) {
    const double t = 1e-3 * i;
    const Vector3d s(1.0 + 0.4 * std::sin(3 * t), 1.0 + 0.3 * std::sin(5 * t), 1.0 - 0.4 * std::sin(4 * t));
    const Matrix3d r = Eigen::AngleAxisd(4.0 * t, axis).toRotationMatrix();
    const DeformationGradient f = fixed_matrix<Stretch>(r * q0 * s.asDiagonal() * q0.transpose());
    extract_rotation(f, q);
    worst_norm = std::max(worst_norm, norm_error(q));
    worst_error = std::max(worst_error, error_degrees(r, q));
  }
  std::printf("norm off by at most %.1f LSB, rotation by %.2g deg\n", worst_norm, worst_error);
  EXPECT_LE(worst_norm, 8.0);
  EXPECT_LT(worst_error, 1e-5);
}

}  // namespace
}  // namespace palpate::test
