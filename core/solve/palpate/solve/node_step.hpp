// The arithmetic of one node's step, as forces accelerate it or as something leads it to a target.
#pragma once

#include "palpate/mesh/forest.hpp"
#include "palpate/numeric/high_word.hpp"
#include "palpate/numeric/opaque.hpp"
#include "palpate/solve/dynamics.hpp"

namespace palpate {
namespace integrate_detail {

/// sum 2^-Shift, cut off, within a word: the upper half of what is beyond becomes the limit's, so its error
/// is 2^(Shift - 33) of it. No branch.
template <int Shift>
PALPATE_ALWAYS_INLINE int32_t shifted_within(int64_t sum, uint32_t& clamped) {
  const auto high = static_cast<int32_t>(sum >> 32);
  const int32_t within = within_bits<Shift>(high);
  clamped |= static_cast<uint32_t>(high ^ within);
  const uint32_t low = static_cast<uint32_t>(sum) >> Shift;
  return static_cast<int32_t>((static_cast<uint32_t>(within) << (32 - Shift)) | low);
}
template <int Shift>
PALPATE_ALWAYS_INLINE int32_t shifted_within(int64_t sum) {
  uint32_t uncounted = 0;
  return shifted_within<Shift>(sum, uncounted);
}

/// v + f impulse - alpha_M dt v, within the range of Velocity.
PALPATE_ALWAYS_INLINE Velocity next_velocity(Velocity v, Force f, Impulse impulse, Q<-5, 36> mass_damping,
                                             uint32_t& clamped) {
  using Drag = Q<-9, 40>;
  constexpr int kBits = Force::kFractionBits + Impulse::kFractionBits;
  constexpr int kShift = kBits - Velocity::kFractionBits;
  constexpr int kOfDrag = kBits - Drag::kFractionBits;
  // Of the drag half an LSB of the velocity is taken, which rounds the sum.
  const Drag drag = multiply_add_high(v, mass_damping, Drag::from_raw(-(1 << (kShift - 1 - kOfDrag))));
  int64_t sum = int64_t{f.raw()} * impulse.raw();
  // Opaque factors: a multiply that adds does it, instead of a shift of two words and an addition.
  sum += int64_t{v.raw()} * opaque(1 << kShift);
  sum += int64_t{drag.raw()} * opaque(-(1 << kOfDrag));
  return Velocity::from_raw(shifted_within<kShift>(sum, clamped));
}

/// x + v
PALPATE_ALWAYS_INLINE Position moved(Position x, Velocity v, uint32_t& clamped) {
  const int32_t next = multiply_add_high(v, Q<8, 23>::ratio(1, 1), x).raw();
  const int32_t within = within_bits<kPositionBits>(next);
  clamped |= static_cast<uint32_t>(next ^ within);
  return Position::from_raw(within);
}

/// x + beta_K v
PALPATE_ALWAYS_INLINE Position force_position(Position x, Velocity v, Q<0, 31> stiffness_damping) {
  const auto ahead = multiply_high<Q<-4, 35>>(v, stiffness_damping);
  const Position sum = multiply_add_high(ahead, Q<7, 24>::ratio(1, 1), x);
  return Position::from_raw(within_bits<kPositionBits>(sum.raw()));
}

/// 1 / n; 1 is not in the format.
inline constexpr std::array<Q<0, 31>, kMaxSubsteps + 1> kFractions = {
    Q<0, 31>::max(),       Q<0, 31>::max(),       Q<0, 31>::ratio(1, 2),
    Q<0, 31>::ratio(1, 3), Q<0, 31>::ratio(1, 4), Q<0, 31>::ratio(1, 5),
    Q<0, 31>::ratio(1, 6), Q<0, 31>::ratio(1, 7), Q<0, 31>::ratio(1, 8)};

/// Of a node after a substep. Scalars, as nothing may point into the frame of the loop over nodes.
struct Next {
  Position x0, x1, x2;
  Velocity v0, v1, v2;
};

/// Not 0 where something was.
struct Clamped {
  uint32_t speed, position;
};

PALPATE_ALWAYS_INLINE Next accelerated(const Vector3<Position>& x, const Vector3<Velocity>& v,
                                       const Vector3<Force>& f, Impulse impulse, Q<-5, 36> mass_damping,
                                       Clamped& clamped) {
  const auto next_v = [&](Eigen::Index axis) {
    return next_velocity(v[axis], f[axis], impulse, mass_damping, clamped.speed);
  };
  const Velocity v0 = next_v(0), v1 = next_v(1), v2 = next_v(2);
  return Next{moved(x[0], v0, clamped.position),
              moved(x[1], v1, clamped.position),
              moved(x[2], v2, clamped.position),
              v0,
              v1,
              v2};
}

/// One axis of a node that something moves: how far in a substep, and where to.
struct Step {
  int32_t x;
  int32_t by;

  [[nodiscard]] Position position() const { return Position::from_raw(x); }
  [[nodiscard]] Velocity velocity() const {
    constexpr int kShift = Velocity::kFractionBits - Position::kFractionBits;
    return Velocity::from_raw(static_cast<int32_t>(static_cast<uint32_t>(by) << kShift));
  }
};

/// The first of `steps` equal steps to the target, each of whole LSBs: what rounding would leave in the end
/// is taken off at once, so the substeps after this one find the same step. A target that is too far is not
/// reached. IsOnly: there are no other steps.
template <bool IsOnly>
PALPATE_ALWAYS_INLINE Step step_towards(Position target, Position x, uint32_t steps, uint32_t& clamped) {
  constexpr int kShift = Velocity::kFractionBits - Position::kFractionBits;
  const int32_t way = target.raw() - x.raw();
  const int32_t step =
      IsOnly ? way : multiply_high<Position>(Q<3, 28>::from_raw(2 * way), kFractions[steps]).raw();
  const int32_t within = within_bits<32 - kShift>(step);
  clamped |= static_cast<uint32_t>(step ^ within);
  if constexpr (IsOnly) return Step{x.raw() + within, within};
  const int32_t is_near = ((step ^ within) - 1) >> 31;  // without a branch: a clamp keeps the sign
  const int32_t taken_off = way - static_cast<int32_t>(steps) * within;
  return Step{x.raw() + within + (taken_off & is_near), within};
}

template <bool IsOnly>
PALPATE_ALWAYS_INLINE Next led_towards(const Vector3<Position>& target, const Vector3<Position>& x,
                                       uint32_t steps, Clamped& clamped) {
  const Step s0 = step_towards<IsOnly>(target[0], x[0], steps, clamped.speed);
  const Step s1 = step_towards<IsOnly>(target[1], x[1], steps, clamped.speed);
  const Step s2 = step_towards<IsOnly>(target[2], x[2], steps, clamped.speed);
  return Next{s0.position(), s1.position(), s2.position(), s0.velocity(), s1.velocity(), s2.velocity()};
}

}  // namespace integrate_detail

}  // namespace palpate
