// The Premium 1.5 in motion: rigid bodies, rotors, friction, stops, joint torques and a load at the tip.
//   (M + J eta^2) q'' = tau + J^T F - V - G + friction + stops
// All SI: rad, rad/s, N m, N, m, s.
#pragma once

#include "plant/joint_friction.hpp"
#include "plant/joint_stops.hpp"
#include "plant/rigid_body.hpp"
#include "plant/tip_load.hpp"

namespace palpate::plant {

struct ArmParameters {
  PremiumBodies bodies;
  double gravity = 9.81;  ///< m/s^2
  /// J eta^2: 1.03e-6 kg m^2 (Maxon RE25 118743) times the squares of the capstan ratios 13.3, 11.2, 11.2.
  Eigen::Vector3d rotor_inertia{1.82e-4, 1.29e-4, 1.29e-4};
  JointFriction friction;
  JointStops stops;
};

struct ArmState {
  Eigen::Vector3d q = Eigen::Vector3d::Zero();      ///< rad; zero: links orthogonal
  Eigen::Vector3d rates = Eigen::Vector3d::Zero();  ///< rad/s
};

class ArmDynamics {
 public:
  explicit ArmDynamics(const ArmParameters& parameters);

  /// q'' at `time` seconds into the substep that the load is for.
  [[nodiscard]] Eigen::Vector3d acceleration(const ArmState& state, const Eigen::Vector3d& torques,
                                             const TipLoad& load, double time) const;
  /// F of the load at the start of its substep, its mass included, N.
  [[nodiscard]] Eigen::Vector3d tip_force(const ArmState& state, const Eigen::Vector3d& torques,
                                          const TipLoad& load) const;

  /// One substep with the classic fourth-order Runge-Kutta method; torques and load are held.
  /// Why this one: nothing here is stiff. The fastest rates are a stop's damping on a link, 0.1 / 1e-3 = 100
  /// / s, and the friction's steepest slope, as much: at 10 kHz a substep is 0.01 of their time, over which
  /// the method errs by some 1e-10. A symplectic method would have to solve for q', since M depends on q. A
  /// fixed number of operations in a fixed order gives the same bits in each run.
  [[nodiscard]] ArmState advance(const ArmState& state, const Eigen::Vector3d& torques, const TipLoad& load,
                                 double substep) const;

  /// Kinetic (rotors included), in the field of gravity and in the stops' springs, J. A load's is not in it.
  [[nodiscard]] double energy(const ArmState& state) const;

  /// M + J eta^2, kg m^2.
  [[nodiscard]] Eigen::Matrix3d mass_matrix(const Eigen::Vector3d& q) const;
  [[nodiscard]] const RigidBody& bodies() const { return bodies_; }

 private:
  ArmParameters parameters_;
  RigidBody bodies_;
  Links links_;
};

}  // namespace palpate::plant
