#include "plant/arm_dynamics.hpp"

#include <Eigen/Cholesky>

namespace palpate::plant {

ArmDynamics::ArmDynamics(const ArmParameters& parameters)
    : parameters_(parameters), bodies_(parameters.bodies, parameters.gravity), links_(premium::links()) {}

Eigen::Matrix3d ArmDynamics::mass_matrix(const Eigen::Vector3d& q) const {
  Eigen::Matrix3d M = bodies_.mass_matrix(q);
  M.diagonal() += parameters_.rotor_inertia;
  return M;
}

Eigen::Vector3d ArmDynamics::acceleration(const ArmState& state, const Eigen::Vector3d& torques,
                                          const TipLoad& load, double time) const {
  const auto& [q, rates] = state;
  const Eigen::Matrix3d J = arm_jacobian(links_, q);
  const Eigen::Vector3d stretch = load.anchor + load.anchor_velocity * time - arm_position(links_, q);
  // The part of the load that q'' has no share in; the rest of -mass P'' is mass J^T J q'', on the left side.
  const Eigen::Vector3d force = load.force + load.stiffness * stretch +
                                load.damping * (load.anchor_velocity - J * rates) -
                                load.mass * arm_acceleration_at_constant_rates(links_, q, rates);
  const Eigen::Vector3d sum = torques + J.transpose() * force - bodies_.velocity_torques(q, rates) -
                              bodies_.gravity_torques(q) + parameters_.friction.torques(rates) +
                              parameters_.stops.torques(q, rates);
  const Eigen::Matrix3d M = mass_matrix(q) + load.mass * J.transpose() * J;
  return M.llt().solve(sum);
}

Eigen::Vector3d ArmDynamics::tip_force(const ArmState& state, const Eigen::Vector3d& torques,
                                       const TipLoad& load) const {
  const auto& [q, rates] = state;
  const Eigen::Matrix3d J = arm_jacobian(links_, q);
  const Eigen::Vector3d tip_acceleration =
      J * acceleration(state, torques, load, 0.0) + arm_acceleration_at_constant_rates(links_, q, rates);
  return load.force + load.stiffness * (load.anchor - arm_position(links_, q)) +
         load.damping * (load.anchor_velocity - J * rates) - load.mass * tip_acceleration;
}

ArmState ArmDynamics::advance(const ArmState& state, const Eigen::Vector3d& torques, const TipLoad& load,
                              double substep) const {
  const double half = substep / 2.0;
  const auto ahead = [&state](const ArmState& slope, double time) {
    return ArmState{state.q + time * slope.q, state.rates + time * slope.rates};
  };
  const auto slope_at = [&](const ArmState& at, double time) {
    return ArmState{at.rates, acceleration(at, torques, load, time)};
  };
  const ArmState k1 = slope_at(state, 0.0);
  const ArmState k2 = slope_at(ahead(k1, half), half);
  const ArmState k3 = slope_at(ahead(k2, half), half);
  const ArmState k4 = slope_at(ahead(k3, substep), substep);
  return {state.q + substep / 6.0 * (k1.q + 2.0 * k2.q + 2.0 * k3.q + k4.q),
          state.rates + substep / 6.0 * (k1.rates + 2.0 * k2.rates + 2.0 * k3.rates + k4.rates)};
}

double ArmDynamics::energy(const ArmState& state) const {
  return 0.5 * state.rates.dot(mass_matrix(state.q) * state.rates) + bodies_.potential_energy(state.q) +
         parameters_.stops.energy(state.q);
}

}  // namespace palpate::plant
