// A motor's winding: volts to amperes to torque. Maxon RE25 118743 (published): R 2.18 ohm at 25 deg C, L
// 0.238 mH, Kt 0.0234 N m/A, which is also the back EMF's constant in V s/rad.
#pragma once

#include "plant/figure.hpp"

namespace palpate::plant {

inline constexpr Figure kSupplyVoltage{"amplifier supply", 24.0, "V", Mark::kAssumed,
                                       "not published; enough for 5.5 A in a winding at 100 deg C"};

struct WindingParameters {
  double resistance_at_25 = 2.18;                ///< ohm
  double resistance_rise = 0.00393;              ///< of copper, 1/K
  double inductance = 0.238e-3;                  ///< H
  double torque_constant = 0.0234;               ///< N m/A, V s/rad
  double supply_voltage = kSupplyVoltage.value;  ///< V

  /// R = R25 (1 + 0.00393 (T - 25)), ohm, T in deg C.
  [[nodiscard]] double resistance(double temperature) const {
    return resistance_at_25 * (1.0 + resistance_rise * (temperature - 25.0));
  }
};

/// What a winding did in one substep.
struct WindingStep {
  double current;      ///< at its end, A
  double mean;         ///< A; torque is Kt times it
  double mean_square;  ///< A^2; heat is R times it
};

struct WindingDrive {
  bool is_on;         ///< off: the bridge lets the current die away through its diodes
  double target;      ///< A
  double back_emf;    ///< Kt times the motor's speed, V
  double resistance;  ///< at its temperature, ohm
};

/// Current mode, with these assumptions: the amplifier measures the current and knows R and the back EMF, so
/// that it puts u = R target + emf on the winding, within +-supply. Then L i' = u - R i - emf is
///   i' = (settled - i) R / L,   settled = (u - emf) / R
/// A faster current loop would only be better. Off, i' = -i R / L, and an idle motor is not braked. Solved in
/// closed form, with speed and target held over the substep.
WindingStep advance_winding(const WindingParameters& winding, const WindingDrive& drive, double current,
                            double substep);

}  // namespace palpate::plant
