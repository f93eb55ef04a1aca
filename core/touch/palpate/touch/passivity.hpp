// Passivity observer and controller (Hannaford and Ryu 2002) at the tool. What the hand has put in so far,
//   E += - F . dx     F the force on the tool, dx what the tool moved in this tick,
// must not become negative: the touched body would have given more than it got. Where it would, a damper
// takes the difference out in the same tick,
//   F -= alpha dx,  alpha = - E / |dx|^2,
// which leaves E = 0: all roundings are up, so never below it. alpha has a limit, and at less than kLeastStep
// there is no direction to damp in; then what is missing stays in E, and is taken out later.
//
// The damper stands on the ground: its force is the tool's alone and never acts on the body.
#pragma once

#include "palpate/mesh/node_state.hpp"
#include "palpate/touch/direction.hpp"

namespace palpate {

/// Force an edge, or a tick's way of an edge: 0 .. 1024 E_ref edge, LSB 2^-21.
using Coupling = Q<10, 21>;
/// E_ref edge^3, LSB 2^-40 (1e-13 J for 500 Pa and 64 mm). Within +-kEnergyLimit.
using Energy = Acc<40>;
inline constexpr Energy kEnergyLimit = Energy::from_raw(int64_t{1} << 60);

/// Of a tool that the controller brakes, in a tick: 2^-16 edge (1 um at 64 mm).
inline constexpr Position kLeastStep = Position::from_raw(1 << 11);
/// No component of the controller's force is more.
inline constexpr Force kMostDampingForce = Force::ratio(1, 1);

struct PassivityRules {
  // E saturates here: energy that the hand put in long ago does not excuse a body that is active now.
  // At least 1, in 2^-20 E_ref edge^3.
  uint32_t ceiling;
  Coupling most_damping;  // of alpha, 0: observe only
};

struct Passivity {
  Energy energy;
  bool is_braking;  // in the last tick

  static Passivity at_rest() { return Passivity{Energy::from_raw(0), false}; }
  /// What is missing is given up.
  void forgive() {
    if (energy.raw() < 0) energy = Energy::from_raw(0);
  }
};

namespace passivity_detail {

/// - F . dx, rounded up. The sum fits 64 bits: 3 x 9 x 8 < 2^8, with 52 fraction bits.
inline Energy work(const Vector3<Force>& force, const Vector3<Position>& moved) {
  constexpr int kShift = Force::kFractionBits + Position::kFractionBits - Energy::kFractionBits;
  return Energy::from_raw(-(dot(force, moved).raw() >> kShift));
}

inline Energy saturated(Energy energy, uint32_t ceiling) {
  const auto most = Energy::from_raw(int64_t{ceiling} << 20);
  if (energy < -kEnergyLimit) return -kEnergyLimit;
  return energy > most ? most : energy;
}

/// missing / |dx|^2, rounded up, at most `most`. missing > 0, |dx| >= kLeastStep.
inline Coupling damping_for(Energy missing, const Vector3<Position>& moved, Coupling most) {
  // |dx|^2 = m 2^(10 - room), m in [1/2, 1)
  const auto square = static_cast<uint64_t>(square_of(moved).raw());
  const int room = leading_zeros_of_64(square);
  const auto mantissa = Q<0, 31>::from_raw(static_cast<int32_t>(square << room >> 33));
  // The mantissa is cut and the reciprocal has 1 LSB: 4 are up.
  const int64_t inverse = int64_t{reciprocal_normalised(mantissa).raw()} + 4;
  const int used = 64 - leading_zeros_of_64(static_cast<uint64_t>(missing.raw()));
  const int cut = used > 31 ? used - 31 : 0;
  const int64_t known = (missing.raw() >> cut) + (cut > 0 ? 1 : 0);
  // alpha = known 2^(cut - 40) inverse 2^-30 2^(room - 10), of which 2^-21 is one LSB
  const int shift = 40 + 30 + 10 - Coupling::kFractionBits - room - cut;
  if (shift <= 0) return most;  // 2^60 and more
  const int64_t raw = (known * inverse >> shift) + 1;
  return raw > most.raw() ? most : Coupling::from_raw(static_cast<int32_t>(raw));
}

/// alpha dx, away from zero.
inline Force braking(Coupling alpha, Position moved) {
  constexpr int kShift = Coupling::kFractionBits + Position::kFractionBits - Force::kFractionBits;
  const int64_t product = int64_t{alpha.raw()} * moved.raw();
  const int64_t size = product < 0 ? -product : product;
  const int64_t up = (size + (int64_t{1} << kShift) - 1) >> kShift;
  const int64_t within = up > kMostDampingForce.raw() ? kMostDampingForce.raw() : up;
  return Force::from_raw(static_cast<int32_t>(product < 0 ? -within : within));
}

}  // namespace passivity_detail

/// The force on the tool after the controller, for `observe` to see. `force` is within +-8, `moved` within
/// +-8 edges. Cost: 6 products, one reciprocal.
inline Vector3<Force> made_passive(const PassivityRules& rules, const Vector3<Force>& force,
                                   const Vector3<Position>& moved, Passivity& passivity) {
  namespace detail = passivity_detail;
  const Energy without = passivity.energy + detail::work(force, moved);
  const bool is_moving = square_of(moved) >= kLeastStep * kLeastStep;
  passivity.is_braking = without.raw() < 0 && is_moving && rules.most_damping.raw() > 0;
  if (!passivity.is_braking) return force;
  const Coupling alpha = detail::damping_for(-without, moved, rules.most_damping);
  return Vector3<Force>(force[0] - detail::braking(alpha, moved[0]),
                        force[1] - detail::braking(alpha, moved[1]),
                        force[2] - detail::braking(alpha, moved[2]));
}

/// Adds the work of the force that the tool gets. The energy is never below 0 afterwards unless alpha, its
/// force, kLeastStep or a later limit stood in the way; then it is what is missing. Cost: 3 products.
inline void observe(const PassivityRules& rules, const Vector3<Force>& force, const Vector3<Position>& moved,
                    Passivity& passivity) {
  namespace detail = passivity_detail;
  passivity.energy = detail::saturated(passivity.energy + detail::work(force, moved), rules.ceiling);
}

}  // namespace palpate
