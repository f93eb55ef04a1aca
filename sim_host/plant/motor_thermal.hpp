// A motor's temperatures: winding and housing, two masses.
//   Cw Tw' = R i^2 - (Tw - Th) / Rwh,   Ch Th' = (Tw - Th) / Rwh - (Th - Ta) / Rha,   R at Tw
// Maxon RE25 118743: Rwh 3.1 and Rha 14 K/W, limit 100 deg C (published); Cw 3.87 and Ch 43.7 J/K from the
// published time constants of 12 and 612 s (computed). Temperatures in deg C.
#pragma once

#include "plant/winding.hpp"

namespace palpate::plant {

struct ThermalParameters {
  double winding_to_housing = 3.1;   ///< Rwh, K/W
  double housing_to_ambient = 14.0;  ///< Rha, K/W
  double winding_capacity = 3.87;    ///< Cw, J/K
  double housing_capacity = 43.7;    ///< Ch, J/K
  double ambient = 25.0;             ///< Ta
  double winding_limit = 100.0;      ///< above it the winding is damaged
};

struct MotorTemperatures {
  double winding = 25.0;
  double housing = 25.0;
};

/// After `seconds` at a mean square current, A^2. One step of the classic Runge-Kutta method: for steps well
/// below the 12 s of the winding.
MotorTemperatures advance_temperatures(const ThermalParameters& thermal, const WindingParameters& winding,
                                       const MotorTemperatures& now, double mean_square_current,
                                       double seconds);

}  // namespace palpate::plant
