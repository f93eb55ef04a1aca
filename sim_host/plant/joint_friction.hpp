#pragma once

#include <Eigen/Core>
#include <cmath>

#include "plant/figure.hpp"

namespace palpate::plant {

inline constexpr Figure kViscousFriction{"viscous friction", 0.0005, "N m s/rad", Mark::kUnverified,
                                         "mahilab/Phantom: tuned by hand, not identified"};
inline constexpr Figure kCoulombFriction{"Coulomb friction", 0.01, "N m", Mark::kUnverified,
                                         "mahilab/Phantom: tuned by hand, not identified"};

/// Each joint's own: -(B q' + F tanh(10 q')), in N m. The tanh has no stiction: held against a torque below
/// F, a joint creeps.
struct JointFriction {
  double viscous = kViscousFriction.value;  ///< B
  double coulomb = kCoulombFriction.value;  ///< F
  double steepness = 10.0;                  ///< s/rad

  [[nodiscard]] Eigen::Vector3d torques(const Eigen::Vector3d& rates) const {
    return -viscous * rates -
           coulomb * (steepness * rates.array()).unaryExpr([](double x) { return std::tanh(x); }).matrix();
  }
};

}  // namespace palpate::plant
