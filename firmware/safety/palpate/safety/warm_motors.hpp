// Keeps the motors from burning: above a threshold a motor's current limit falls by a factor a tick to what
// it stands for ever, below a lower one it comes back along a line. At the winding's limit it is a fault.
#pragma once

#include "palpate/safety/condition_set.hpp"
#include "palpate/safety/motor_heat.hpp"

namespace palpate::safety {

struct WarmMotor {
  MotorTemperatures temperatures;
  Ampere current_limit;
  bool is_warm;
  bool is_overheated;
};

struct WarmMotors {
  std::array<WarmMotor, 3> motors;
};

constexpr WarmMotors make_warm_motors(const ThermalLimits& limits) {
  const WarmMotor cold{motor_at(limits.ambient), limits.peak_amperes, false, false};
  return {{cold, cold, cold}};
}

/// The current limit of the next tick. Warm from above `warm` to below `release`; between them the limit
/// stays. Overheated from winding_limit to `warm`. 1 multiply.
constexpr void limit_current(WarmMotor& motor, const ThermalLimits& limits) {
  const Celsius winding = celsius(motor.temperatures.winding);
  motor.is_overheated = winding >= limits.winding_limit || (motor.is_overheated && winding > limits.warm);
  motor.is_warm = winding > limits.warm || (motor.is_warm && winding >= limits.release);
  if (winding > limits.warm) {
    const Ampere lower = narrow<Ampere>(motor.current_limit * limits.decay_per_tick);
    motor.current_limit = lower < limits.continuous_amperes ? limits.continuous_amperes : lower;
  } else if (!motor.is_warm) {
    const Ampere room = limits.peak_amperes - motor.current_limit;
    motor.current_limit += room < limits.rise_amperes_per_tick ? room : limits.rise_amperes_per_tick;
  }
}

/// `currents`: those of the last tick. 21 multiplies.
inline ConditionSet watch_motors(WarmMotors& warm, const ThermalModel& model, const ThermalLimits& limits,
                                 const std::array<Ampere, 3>& currents) {
  bool is_warm = false;
  bool is_overheated = false;
  for (const uint32_t i : bounded<3>(3, [] {})) {
    WarmMotor& motor = warm.motors[i];
    heat_up(motor.temperatures, model, limits.ambient, currents[i]);
    limit_current(motor, limits);
    is_warm = is_warm || motor.is_warm;
    is_overheated = is_overheated || motor.is_overheated;
  }
  return ConditionSet::of(Condition::kWarmMotors, is_warm) |
         ConditionSet::of(Condition::kMotorOverheated, is_overheated);
}

}  // namespace palpate::safety
