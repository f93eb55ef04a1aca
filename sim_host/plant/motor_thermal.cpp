#include "plant/motor_thermal.hpp"

namespace palpate::plant {

MotorTemperatures advance_temperatures(const ThermalParameters& thermal, const WindingParameters& winding,
                                       const MotorTemperatures& now, double mean_square_current,
                                       double seconds) {
  const auto slope = [&](const MotorTemperatures& at) {
    const double heat = winding.resistance(at.winding) * mean_square_current;
    const double to_housing = (at.winding - at.housing) / thermal.winding_to_housing;
    const double to_ambient = (at.housing - thermal.ambient) / thermal.housing_to_ambient;
    return MotorTemperatures{(heat - to_housing) / thermal.winding_capacity,
                             (to_housing - to_ambient) / thermal.housing_capacity};
  };
  const auto ahead = [&now](const MotorTemperatures& rate, double time) {
    return MotorTemperatures{now.winding + time * rate.winding, now.housing + time * rate.housing};
  };
  const MotorTemperatures k1 = slope(now);
  const MotorTemperatures k2 = slope(ahead(k1, seconds / 2.0));
  const MotorTemperatures k3 = slope(ahead(k2, seconds / 2.0));
  const MotorTemperatures k4 = slope(ahead(k3, seconds));
  const auto mean = [](double a, double b, double c, double d) { return (a + 2.0 * b + 2.0 * c + d) / 6.0; };
  return ahead({mean(k1.winding, k2.winding, k3.winding, k4.winding),
                mean(k1.housing, k2.housing, k3.housing, k4.housing)},
               seconds);
}

}  // namespace palpate::plant
