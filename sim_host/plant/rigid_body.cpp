#include "plant/rigid_body.hpp"

#include <cmath>

namespace palpate::plant {

RigidBody::RigidBody(const PremiumBodies& bodies, double gravity) {
  const auto& [a, c, be, df, base_inertia_y, l1, l2, l3, l5, l6] = bodies;
  // Distances from the turret's axis are l1 c2 + l2/2 s3 for a and l1/2 c2 + l3 s3 for c: what multiplies
  // c2^2, s3^2 and 2 c2 s3 in the sum of m r^2.
  const double upper = l1 * l1 * (a.mass + c.mass / 4.0);
  const double fore = l2 * l2 * a.mass / 4.0 + l3 * l3 * c.mass;
  const double both = l1 * l2 * a.mass / 2.0 + l1 * l3 * c.mass / 2.0;
  // A body that leans by an angle turns with I_y cos^2 + I_z sin^2 about the vertical. With cos^2 and sin^2
  // of an angle as (1 +- cos of twice the angle) / 2:
  const double sum2 = be.inertia_y + be.inertia_z + c.inertia_y + c.inertia_z;
  const double sum3 = a.inertia_y + a.inertia_z + df.inertia_y + df.inertia_z;
  const double lean2 = be.inertia_y - be.inertia_z + c.inertia_y - c.inertia_z;
  const double lean3 = a.inertia_y - a.inertia_z + df.inertia_y - df.inertia_z;
  a0_ = base_inertia_y + (upper + fore + sum2 + sum3) / 2.0;
  a1_ = (upper + lean2) / 2.0;
  a2_ = (-fore + lean3) / 2.0;
  a3_ = 2.0 * both;
  a4_ = both;
  m22_ = upper + be.inertia_x + c.inertia_x;
  m33_ = fore + a.inertia_x + df.inertia_x;
  u2_ = gravity * (l1 * a.mass + l1 * c.mass / 2.0 + l5 * be.mass);
  u3_ = gravity * (l2 * a.mass / 2.0 + l3 * c.mass - l6 * df.mass);
}

Eigen::Matrix3d RigidBody::mass_matrix(const Eigen::Vector3d& q) const {
  const double m11 =
      a0_ + a1_ * std::cos(2.0 * q[1]) + a2_ * std::cos(2.0 * q[2]) + a3_ * std::cos(q[1]) * std::sin(q[2]);
  const double m23 = -a4_ * std::sin(q[1] - q[2]);
  Eigen::Matrix3d M;
  M << m11, 0, 0, 0, m22_, m23, 0, m23, m33_;
  return M;
}

Eigen::Vector3d RigidBody::velocity_torques(const Eigen::Vector3d& q, const Eigen::Vector3d& rates) const {
  const double d2 = -2.0 * a1_ * std::sin(2.0 * q[1]) - a3_ * std::sin(q[1]) * std::sin(q[2]);
  const double d3 = -2.0 * a2_ * std::sin(2.0 * q[2]) + a3_ * std::cos(q[1]) * std::cos(q[2]);
  const double e = a4_ * std::cos(q[1] - q[2]);
  return {rates[0] * (d2 * rates[1] + d3 * rates[2]),
          -0.5 * d2 * rates[0] * rates[0] + e * rates[2] * rates[2],
          -0.5 * d3 * rates[0] * rates[0] - e * rates[1] * rates[1]};
}

Eigen::Vector3d RigidBody::gravity_torques(const Eigen::Vector3d& q) const {
  return {0.0, u2_ * std::cos(q[1]), u3_ * std::sin(q[2])};
}

double RigidBody::potential_energy(const Eigen::Vector3d& q) const {
  return u2_ * std::sin(q[1]) - u3_ * std::cos(q[2]);
}

}  // namespace palpate::plant
