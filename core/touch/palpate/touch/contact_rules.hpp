// How a tool touches: what a model says of it.
#pragma once

#include "palpate/touch/passivity.hpp"

namespace palpate {

/// So that it fits beside elastic forces and tethers at one node (docs/numerics.md).
inline constexpr Force kContactForceLimit = Force::ratio(1, 1);
/// A force of that limit that turns around.
inline constexpr Force kMostContactSlew = Force::ratio(2, 1);
/// Of a tool's radius.
inline constexpr Position kLeastRadius = Position::ratio(1, 64);
inline constexpr Position kMostRadius = Position::ratio(1, 2);

struct ContactRules {
  // Of the tool; 0: no contact, else kLeastRadius .. kMostRadius. The proxy goes by half of it a tick.
  Position radius;
  Coupling stiffness;  // k, above 0
  Coupling damping;    // b, of a tick's change, 0 or more
  Fraction friction;   // mu, 0 .. below 2
  Force force_limit;   // 0 .. kContactForceLimit
  Force slew;          // most change of the tool's force in a tick, above 0, at most kMostContactSlew
  PassivityRules passivity;

  [[nodiscard]] bool is_on() const { return radius.raw() > 0; }
};

}  // namespace palpate
