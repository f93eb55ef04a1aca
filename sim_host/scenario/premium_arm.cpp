#include "scenario/premium_arm.hpp"

#include <algorithm>
#include <cmath>

#include "palpate/phantom/premium.hpp"
#include "units.hpp"

namespace palpate::sim {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegrees = 180.0 / kPi;
constexpr double kAngleUnit = 2.0 * kPi / 4294967296.0;  // of phantom::Angle's raw value

/// q1, q2, q3, q2 - q3: the last is limited by the parallelogram.
struct Limit {
  double low_deg, high_deg;
};
constexpr std::array<Limit, 4> kLimits = {Limit{-90, 90}, {-124, 119}, {-29, 214}, {-55, 65}};

struct Links {
  double upper = to_double(phantom::premium::kArm.upper);
  double fore = to_double(phantom::premium::kArm.fore);
};

}  // namespace

std::optional<JointAnglesRad> inverse_kinematics(const std::array<double, 3>& position_m) {
  const auto& [x, y, z] = position_m;
  const auto [l1, l2] = Links{};
  const double r = std::hypot(x, y);
  const double d = std::hypot(r, z);
  const double at_shoulder = (l1 * l1 + d * d - l2 * l2) / (2.0 * l1 * d);
  const double at_elbow = (l1 * l1 + l2 * l2 - d * d) / (2.0 * l1 * l2);
  if (!(std::abs(at_shoulder) <= 1.0) || !(std::abs(at_elbow) <= 1.0)) return std::nullopt;
  const double q2 = std::acos(at_shoulder) + std::atan2(z, r);
  return JointAnglesRad{std::atan2(y, x), q2, std::acos(at_elbow) + q2 - kPi / 2.0};
}

std::array<double, 3> forward_kinematics(const JointAnglesRad& angles) {
  const auto [l1, l2] = Links{};
  const double reach = l1 * std::cos(angles.q2) + l2 * std::sin(angles.q3);
  return {reach * std::cos(angles.q1), reach * std::sin(angles.q1),
          l1 * std::sin(angles.q2) - l2 * std::cos(angles.q3)};
}

double margin_to_limits_deg(const JointAnglesRad& angles) {
  const std::array<double, 4> limited = {angles.q1, angles.q2, angles.q3, angles.q2 - angles.q3};
  double least = 360.0;
  for (std::size_t i = 0; i < limited.size(); ++i) {
    const double degrees = limited[i] * kDegrees;
    least = std::min({least, degrees - kLimits[i].low_deg, kLimits[i].high_deg - degrees});
  }
  return least;
}

std::array<double, 3> encoder_counts(const JointAnglesRad& angles) {
  const auto& ratings = phantom::premium::kEncoders;
  const auto& zero = phantom::premium::kPremium15.at_zero_counts;
  const std::array<double, 3> q = {angles.q1, angles.q2, angles.q3};
  const std::array<double, 3> q0 = {zero.q1.raw() * kAngleUnit, zero.q2.raw() * kAngleUnit,
                                    zero.q3.raw() * kAngleUnit};
  std::array<double, 3> counts{};
  for (std::size_t joint = 0; joint < counts.size(); ++joint) {
    const double per_turn = ratings.direction[joint] * ratings.counts_per_joint_turn_milli[joint] / 1000.0;
    counts[joint] = (q[joint] - q0[joint]) / (2.0 * kPi) * per_turn;
  }
  return counts;
}

}  // namespace palpate::sim
