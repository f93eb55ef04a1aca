#include "plant/hand.hpp"

#include <cmath>
#include <utility>

#include "plant/units.hpp"

namespace palpate::plant {

Hand::Hand(const HandParameters& parameters, Intention intention)
    : parameters_(parameters), intention_(std::move(intention)), noise_(parameters.tremor.seed) {}

void Hand::begin_tick(double seconds) {
  const Tremor& tremor = parameters_.tremor;
  if (tremor.rms == 0.0) return;
  // Keeps the variance at rms^2 once it is there, whatever the tick.
  const double kept = std::exp(-2.0 * kPi * tremor.bandwidth * seconds);
  const double fresh = tremor.rms * std::sqrt(1.0 - kept * kept);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    tremor_[axis] = kept * tremor_[axis] + fresh * noise_.normal();
  }
}

TipLoad Hand::load(double time) const {
  const Intent intent = intention_.at(time);
  if (!intent.holds) return {};
  return {tremor_,         intent.position, intent.velocity, parameters_.stiffness, parameters_.damping,
          parameters_.mass};
}

uint16_t Hand::buttons(double time) const {
  const Intent intent = intention_.at(time);
  return intent.holds ? intent.buttons : uint16_t{0};
}

}  // namespace palpate::plant
