// Forces of tethers (mesh/tether.hpp), added to the elastic ones before a substep. With d the node's offset
// from the midpoint of its edge's ends a and b, u = v - (v_a + v_b) / 2 its rate after the substep without
// the tether, and S = w + w_a / 4 + w_b / 4 the rate that a unit force on the node gives it (w: Impulse, 0
// for ends that something else moves), the force on the node is
//   F = - k u / S                 release: k falls from 64/65 to 1/9, then the tether is gone
//   F = - (u + d / substeps left) / S    draw: the node is at the midpoint in the end
// and the ends take half of -F each: linear momentum is exact. A release is an inelastic impulse, which never
// adds kinetic energy. The reaction of a grasped end holds its share of F.
#pragma once

#include "palpate/mesh/tether.hpp"
#include "palpate/solve/integrate.hpp"

namespace palpate {

/// A component of F stays within this, so that forces of many tethers and elements fit at one node.
inline constexpr Force kTetherForceLimit = Force::ratio(1, 2);

/// k of a release by its ticks left, from 1 on, in 2^-16: k / (1 - k) = 2^(9 (ticks - 1) / 31 - 3). As a drag
/// this falls by the same ratio every tick: the node passes its critical damping slowly, whatever its mass
/// and stiffness are, moves to its place meanwhile, and is nearly free in the end.
inline constexpr std::array<uint16_t, kTetherTicks + 1> kReleaseParts = {
    0,     7282,  8690,  10322, 12194, 14319, 16697, 19322, 22172, 25213, 28398,
    31669, 34963, 38212, 41355, 44337, 47115, 49659, 51954, 53993, 55784, 57340,
    58677, 59818, 60785, 61599, 62281, 62850, 63323, 63715, 64040, 64307, 64528};

namespace tether_detail {

/// 1 / S: mantissa 2^-exponent.
struct Inverse {
  Q<1, 30> mantissa;  // (1, 2]
  int exponent;
};

inline Inverse inverse_of(Acc<Impulse::kFractionBits> s) {
  const auto raw = static_cast<uint32_t>(s.raw());  // 0 < S <= 12 with 28 fraction bits
  const int room = leading_zeros(raw);
  const auto mantissa = Q<0, 31>::from_raw(static_cast<int32_t>((raw << room) >> 1));
  // S = mantissa 2^(31 - 28 + 1 - room)
  return Inverse{reciprocal_normalised(mantissa), 32 - Impulse::kFractionBits - room};
}

/// u / S as a force, within the limit.
inline Force force_for(Velocity u, const Inverse& inverse) {
  constexpr int kBits = Velocity::kFractionBits + 30;
  const Acc<kBits> product = u * inverse.mantissa;
  const int64_t raw = shift_right_rounded(product.raw(), kBits - Force::kFractionBits + inverse.exponent);
  const int64_t limit = kTetherForceLimit.raw();
  const int64_t low = raw < -limit ? -limit : raw;
  return Force::from_raw(static_cast<int32_t>(low > limit ? limit : low));
}

}  // namespace tether_detail

template <class Profile>
class TetherForces {
 public:
  TetherForces(Forest<Profile>& forest, const SolveState<Profile>& solve, uint16_t driven)
      : node_(forest.node), solve_(solve), driven_(driven) {}

  /// Forces of one tether for the next substep; `substeps_left` counts it, to the end of the tether.
  void add(const Tether& tether, uint32_t substeps_left) {
    const Node node = node_at(tether.node);
    const Node end0 = node_at(tether.end[0]);
    const Node end1 = node_at(tether.end[1]);
    const auto s = Acc<Impulse::kFractionBits>::from_raw(
        int64_t{node.mobility.raw()} + ((int64_t{end0.mobility.raw()} + end1.mobility.raw()) >> 2));
    if (s.raw() == 0) return;
    const auto inverse = tether_detail::inverse_of(s);
    const Aim aim = tether.kind == TetherKind::kRelease
                        ? Aim{kReleaseParts[tether.ticks_left], Part::from_raw(0)}
                        : Aim{1u << kRateBits, part_of(substeps_left)};
    for (const uint32_t axis : bounded<3>(3, [] {})) {
      const auto a = static_cast<Eigen::Index>(axis);
      const Force on_node =
          tether_detail::force_for(wanted(aim, rate(node, end0, end1, a), offset(tether, a)), inverse);
      const Force half = Force::from_raw(on_node.raw() >> 1);
      (*node.force)[a] += on_node;
      (*end0.force)[a] -= half;
      (*end1.force)[a] -= on_node - half;
    }
  }

 private:
  using Part = Q<0, 31>;
  static constexpr int kRateBits = 16;
  /// What a tether takes off in a substep: this much of u, in 2^-16, and of d.
  struct Aim {
    uint32_t of_rate;
    Part of_offset;
  };
  struct Node {
    const Vector3<Velocity>* velocity;
    Vector3<Force>* force;
    Impulse mobility;  // 0 for one that something else moves
  };

  [[nodiscard]] Node node_at(uint16_t node) {
    const int32_t if_free = integrate_detail::mask_if_free(solve_.control[node], node, driven_);
    return Node{&node_.velocity[node], &node_.force[node],
                Impulse::from_raw(solve_.impulse[node].raw() & if_free)};
  }
  /// Velocity after the substep, without damping.
  [[nodiscard]] static Acc<53> next(const Node& node, Eigen::Index a) {
    return widen<53>((*node.velocity)[a]) + (*node.force)[a] * node.mobility;
  }
  /// u
  [[nodiscard]] static Velocity rate(const Node& node, const Node& end0, const Node& end1, Eigen::Index a) {
    const int64_t ends = (next(end0, a).raw() >> 1) + (next(end1, a).raw() >> 1);
    return narrow_saturated<Velocity>(next(node, a) - Acc<53>::from_raw(ends));
  }
  /// d
  [[nodiscard]] Position offset(const Tether& tether, Eigen::Index a) const {
    const auto& x = node_.position;
    const auto ends = widen<Position::kFractionBits>(x[tether.end[0]][a]) +
                      widen<Position::kFractionBits>(x[tether.end[1]][a]);
    return x[tether.node][a] - narrow<Position>(divide_by_power_of_two<1>(ends));
  }
  /// 1 / substeps left.
  static Part part_of(uint32_t substeps_left) {
    const int room = leading_zeros(substeps_left);
    const auto mantissa = Q<0, 31>::from_raw(static_cast<int32_t>((substeps_left << room) >> 1));
    const int64_t raw = reciprocal_normalised(mantissa).raw();  // 1 / n = raw 2^-30 2^-(32 - room)
    const int64_t scaled = (raw << 1) >> (32 - room);
    return Part::from_raw(static_cast<int32_t>(scaled > 0x7fffffff ? 0x7fffffff : scaled));
  }
  /// - (of_rate u + of_offset d)
  static Velocity wanted(const Aim& aim, Velocity u, Position d) {
    const auto of_u = Acc<58>::from_raw(int64_t{u.raw()} * static_cast<int32_t>(aim.of_rate) *
                                        (1 << (58 - kRateBits - Velocity::kFractionBits)));
    return narrow_saturated<Velocity>(-(of_u + d * aim.of_offset));
  }

  NodeState<Profile::kNodes>& node_;
  const SolveState<Profile>& solve_;
  uint16_t driven_;
};

/// Once a tick, before its substeps: the driven node and held ends of tethers have the velocity at which they
/// will be moved in it, since a tether asks how fast its ends are before they are moved.
template <class Profile>
void aim_ends(Forest<Profile>& forest, const Dynamics& dynamics, const HoldMotions& motions,
              const DrivenNode& driven, const SolveState<Profile>& solve, const Tethers<Profile>& tethers) {
  namespace detail = integrate_detail;
  detail::Clamped clamped{0, 0};  // integrate_substep counts it
  const auto aim = [&](uint16_t node, const Vector3<Position>& target) {
    const auto next = detail::led_towards<Profile::kSubsteps == 1>(target, forest.node.position[node],
                                                                   dynamics.substeps, clamped);
    Vector3<Velocity>& v = forest.node.velocity[node];
    v[0] = next.v0;
    v[1] = next.v1;
    v[2] = next.v2;
  };
  for (const uint32_t i : bounded<2 * Profile::kTethers>(2u * tethers.count, [] {})) {
    const uint16_t end = tethers.tether[i / 2].end[i & 1u];
    const NodeControl control = solve.control[end];
    if (control != NodeControl::kFree) aim(end, held_target(forest, motions, control, end));
  }
  if (driven.node != kNone) aim(driven.node, driven.target);
}

/// All tethers, one after the other, for the substep that `remaining` counts (1: the last of the tick).
template <class Profile>
PALPATE_NOINLINE void add_tether_forces(Forest<Profile>& forest, const SolveState<Profile>& solve,
                                        const Tethers<Profile>& tethers, uint32_t substeps,
                                        uint32_t remaining, uint16_t driven) {
  TetherForces<Profile> forces(forest, solve, driven);
  for (const uint32_t i : bounded<Profile::kTethers>(tethers.count, [] {})) {
    const Tether& tether = tethers.tether[i];
    forces.add(tether, (tether.ticks_left - 1u) * substeps + remaining);
  }
}

/// A node that a merge is about to remove gives half of its mass to each end of its edge, and its momentum
/// with it: v_a' = v_a + (v - v_a) m/2 / (m_a + m/2). Momentum is exact to half a velocity LSB, kinetic
/// energy never rises. Ends that something else moves keep their velocity. Call it before merge.
template <class Profile>
void absorb_momentum(Forest<Profile>& forest, const SolveState<Profile>& solve, uint16_t node,
                     const std::array<uint16_t, 2>& ends) {
  auto& velocity = forest.node.velocity;
  const MassUnits half = forest.node.mass[node] / 2;
  for (const uint32_t i : bounded<2>(2, [] {})) {
    const uint16_t end = ends[i];
    if (solve.control[end] != NodeControl::kFree) continue;
    const MassUnits whole = forest.node.mass[end] + half;
    const int room = leading_zeros(whole);
    const auto mantissa = Q<0, 31>::from_raw(static_cast<int32_t>((whole << room) >> 1));
    const int64_t inverse =
        reciprocal_normalised(mantissa).raw();  // 1 / whole = inverse 2^-30 2^-(32 - room)
    const int64_t share = static_cast<int64_t>(half) * inverse >> (62 - room - 31);
    const auto part = Q<0, 31>::from_raw(static_cast<int32_t>(share > 0x7fffffff ? 0x7fffffff : share));
    for (const uint32_t axis : bounded<3>(3, [] {})) {
      const auto a = static_cast<Eigen::Index>(axis);
      velocity[end][a] += narrow<Velocity>(velocity[node][a] * part - velocity[end][a] * part);
    }
  }
}

}  // namespace palpate
