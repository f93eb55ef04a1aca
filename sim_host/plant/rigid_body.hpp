// The Premium 1.5 as rigid bodies: M(q) q'' + V(q, q') + G(q), without motors and friction. All SI: q in rad,
// q' in rad/s, torques in N m.
//
// Source of the bodies: Cavusoglu, Feygin, Tendick 2002, as github.com/mahilab/Phantom quotes it. The reduced
// form below is derived from them:
//   M11 = a0 + a1 cos 2q2 + a2 cos 2q3 + a3 c2 s3,  M22 and M33 constant,  M23 = -a4 sin(q2 - q3),
//   M12 = M13 = 0,  a4 = a3 / 2
//   V = [ q1' (d2 q2' + d3 q3');  -1/2 d2 q1'^2 + e q3'^2;  -1/2 d3 q1'^2 - e q2'^2 ]
//     with d2 = dM11/dq2 = -2 a1 sin 2q2 - a3 s2 s3, d3 = dM11/dq3 = -2 a2 sin 2q3 + a3 c2 c3,
//     and  e = a4 cos(q2 - q3)
//   G = [0; u2 c2; u3 s3], from the potential energy u2 s2 - u3 c3
// The sign in the third row of V follows from Christoffel's symbols; the published transcriptions have a
// plus.
#pragma once

#include <Eigen/Core>

namespace palpate::plant {

/// Mass in kg and the inertia in kg m^2 about the body's axes: x the joints' axis, y up and z forward when
/// the links are orthogonal (link 1 lies along z, link 2 hangs along y).
struct Body {
  double mass, inertia_x, inertia_y, inertia_z;
};

/// Bodies and lengths (m). Inertia about the centre of mass for a and c, about the joint for be and df.
struct PremiumBodies {
  Body a{0.0202, 0.4864e-4, 0.001843e-4, 0.4864e-4};  ///< the fore link, centre half way along it
  Body c{0.0249, 0.959e-4, 0.959e-4, 0.0051e-4};      ///< parallel to the upper link, l3 off it
  Body be{0.2359, 11.09e-4, 10.06e-4, 0.591e-4};      ///< turns with q2; its centre l5 along the link
  Body df{0.1906, 7.11e-4, 0.629e-4, 6.246e-4};       ///< turns with q3; its centre l6 behind
  double base_inertia_y = 11.87e-4;                   ///< turns with q1
  double l1 = 0.215, l2 = 0.170, l3 = 0.0325, l5 = -0.0368, l6 = 0.0527;
};

class RigidBody {
 public:
  /// gravity in m/s^2, along -z of the device.
  RigidBody(const PremiumBodies& bodies, double gravity);

  [[nodiscard]] Eigen::Matrix3d mass_matrix(const Eigen::Vector3d& q) const;
  [[nodiscard]] Eigen::Vector3d velocity_torques(const Eigen::Vector3d& q,
                                                 const Eigen::Vector3d& rates) const;
  [[nodiscard]] Eigen::Vector3d gravity_torques(const Eigen::Vector3d& q) const;
  /// J; zero where the links' heights are zero.
  [[nodiscard]] double potential_energy(const Eigen::Vector3d& q) const;

 private:
  double a0_, a1_, a2_, a3_, a4_, m22_, m33_, u2_, u3_;
};

}  // namespace palpate::plant
