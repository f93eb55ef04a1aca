#include "plant/arm.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace palpate::plant {
namespace {

constexpr double kQuarterTurn = 1.57079632679489661923;

}  // namespace

Eigen::Vector3d arm_position(const Links& links, const Eigen::Vector3d& q) {
  const double reach = links.upper * std::cos(q[1]) + links.fore * std::sin(q[2]);
  return {reach * std::cos(q[0]), reach * std::sin(q[0]),
          links.upper * std::sin(q[1]) - links.fore * std::cos(q[2])};
}

Eigen::Matrix3d arm_jacobian(const Links& links, const Eigen::Vector3d& q) {
  const auto& [l1, l2] = links;
  const double s1 = std::sin(q[0]), s2 = std::sin(q[1]), s3 = std::sin(q[2]);
  const double c1 = std::cos(q[0]), c2 = std::cos(q[1]), c3 = std::cos(q[2]);
  const double reach = l1 * c2 + l2 * s3;
  Eigen::Matrix3d J;
  J << -s1 * reach, -l1 * c1 * s2, l2 * c1 * c3,  //
      c1 * reach, -l1 * s1 * s2, l2 * s1 * c3,    //
      0, l1 * c2, l2 * s3;
  return J;
}

Eigen::Vector3d arm_acceleration_at_constant_rates(const Links& links, const Eigen::Vector3d& q,
                                                   const Eigen::Vector3d& rates) {
  const auto& [l1, l2] = links;
  const double s1 = std::sin(q[0]), s2 = std::sin(q[1]), s3 = std::sin(q[2]);
  const double c1 = std::cos(q[0]), c2 = std::cos(q[1]), c3 = std::cos(q[2]);
  const double turn = rates[0], square2 = rates[1] * rates[1], square3 = rates[2] * rates[2];
  const double reach = l1 * c2 + l2 * s3;
  const double reach_rate = -l1 * s2 * rates[1] + l2 * c3 * rates[2];
  const double inward = reach * turn * turn + l1 * c2 * square2 + l2 * s3 * square3;
  const double sideways = 2 * turn * reach_rate;
  return {-c1 * inward - s1 * sideways, -s1 * inward + c1 * sideways, -l1 * s2 * square2 + l2 * c3 * square3};
}

std::optional<Eigen::Vector3d> arm_inverse(const Links& links, const Eigen::Vector3d& position) {
  const auto& [l1, l2] = links;
  const double r = std::hypot(position[0], position[1]);
  const double d = std::hypot(r, position[2]);
  const double at_shoulder = (l1 * l1 + d * d - l2 * l2) / (2.0 * l1 * d);
  const double at_elbow = (l1 * l1 + l2 * l2 - d * d) / (2.0 * l1 * l2);
  if (!(std::abs(at_shoulder) <= 1.0) || !(std::abs(at_elbow) <= 1.0)) return std::nullopt;
  const double q2 = std::acos(at_shoulder) + std::atan2(position[2], r);
  return Eigen::Vector3d{std::atan2(position[1], position[0]), q2, std::acos(at_elbow) + q2 - kQuarterTurn};
}

double margin_to_limits(const JointLimits& limits, const Eigen::Vector3d& q) {
  const auto within = [](const Range& range, double angle) {
    return std::min(angle - range.low, range.high - angle);
  };
  return std::min({within(limits.q1, q[0]), within(limits.q2, q[1]), within(limits.q3, q[2]),
                   within(limits.fold, q[1] - q[2])});
}

}  // namespace palpate::plant
