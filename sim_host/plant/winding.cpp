#include "plant/winding.hpp"

#include <algorithm>
#include <cmath>

namespace palpate::plant {

WindingStep advance_winding(const WindingParameters& winding, const WindingDrive& drive, double current,
                            double substep) {
  const auto& [is_on, target, back_emf, resistance] = drive;
  const double voltage =
      std::clamp(resistance * target + back_emf, -winding.supply_voltage, winding.supply_voltage);
  const double settled = is_on ? (voltage - back_emf) / resistance : 0.0;
  // i(t) = settled + away e^(-t / time)
  const double time = winding.inductance / resistance;
  const double away = current - settled;
  const double left = std::exp(-substep / time);
  const double mean_left = time / substep * (1.0 - left);
  const double mean_left_square = time / (2.0 * substep) * (1.0 - left * left);
  return {settled + away * left, settled + away * mean_left,
          settled * settled + 2.0 * settled * away * mean_left + away * away * mean_left_square};
}

}  // namespace palpate::plant
