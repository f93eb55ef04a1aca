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

template <class Profile>
class TetherForces {
 public:
  TetherForces(Forest<Profile>& forest, const SolveState<Profile>& solve, uint16_t driven)
      : node_(forest.node), solve_(solve), driven_(driven) {}

  /// Forces of one tether for the next substep; `substeps_left` counts it, to the end of the tether. No
  /// branch but for a tether whose nodes all are moved.
  void add(const Tether& tether, uint32_t substeps_left) {
    const Node node = node_at(tether.node);
    const Node end0 = node_at(tether.end[0]);
    const Node end1 = node_at(tether.end[1]);
    // 0 .. 12 in the format of Impulse: a word without a sign.
    const auto word = [](const Node& of) { return static_cast<uint32_t>(of.mobility.raw()); };
    const uint32_t s = word(node) + ((word(end0) + word(end1)) >> 2);
    if (s == 0) return;
    const Inverse inverse = inverse_of(s);
    const Aim aim = aim_of(tether, substeps_left);
    add_along(0, node, end0, end1, aim, inverse);
    add_along(1, node, end0, end1, aim, inverse);
    add_along(2, node, end0, end1, aim, inverse);
  }

 private:
  /// What a tether changes in a substep: u by this much of it, in 2^-16, and by this much of d. Not above 0.
  struct Aim {
    int32_t of_rate;
    Q<0, 31> of_offset;
  };
  /// 1 / S = mantissa 2^(room - 4)
  struct Inverse {
    Q<1, 30> mantissa;  // (1, 2]
    int32_t two_to_room;
  };
  struct Node {
    const Vector3<Position>* position;
    const Vector3<Velocity>* velocity;
    Vector3<Force>* force;
    Impulse mobility;  // 0 for one that something else moves
  };

  PALPATE_ALWAYS_INLINE static void add_along(Eigen::Index axis, const Node& node, const Node& end0,
                                              const Node& end1, const Aim& aim, const Inverse& inverse) {
    const Velocity u = rate(node, end0, end1, axis);
    const Force on_node = force_for(wanted(aim, u, offset(node, end0, end1, axis)), inverse);
    const Force half = Force::from_raw(on_node.raw() >> 1);
    // All is loaded before any is stored: a load may have to wait for a store.
    const Force of_node = (*node.force)[axis] + on_node;
    const Force of_end0 = (*end0.force)[axis] - half;
    const Force of_end1 = (*end1.force)[axis] - (on_node - half);
    (*node.force)[axis] = of_node;
    (*end0.force)[axis] = of_end0;
    (*end1.force)[axis] = of_end1;
  }

  [[nodiscard]] Node node_at(uint16_t node) {
    const int32_t if_free = integrate_detail::mask_if_free(solve_.control[node], node, driven_);
    return Node{&node_.position[node], &node_.velocity[node], &node_.force[node],
                Impulse::from_raw(solve_.impulse[node].raw() & if_free)};
  }
  static Inverse inverse_of(uint32_t s) {
    const int room = leading_zeros(s);
    const auto mantissa = Q<0, 31>::from_raw(static_cast<int32_t>((s << room) >> 1));
    // S of one LSB, for which every force is the limit, has a room too much for a factor.
    return Inverse{reciprocal_normalised(mantissa), int32_t{1} << (room < 30 ? room : 30)};
  }
  /// A word's division takes the core less than a reciprocal, and less than a branch around it.
  static Aim aim_of(const Tether& tether, uint32_t substeps_left) {
    const uint32_t part = 0x7fffffffu / substeps_left;
    const int32_t draws = -static_cast<int32_t>(tether.kind);
    static_assert(static_cast<int32_t>(TetherKind::kRelease) == 0 &&
                  static_cast<int32_t>(TetherKind::kDraw) == 1);
    const int32_t released = kReleaseParts[tether.ticks_left];
    return Aim{-((released & ~draws) | ((1 << kRateBits) & draws)),
               Q<0, 31>::from_raw(-(static_cast<int32_t>(part) & draws))};
  }
  /// u: of velocities after the substep, without damping. Half of a mobility is cut off to whole LSBs.
  [[nodiscard]] static Velocity rate(const Node& node, const Node& end0, const Node& end1, Eigen::Index a) {
    constexpr int kShift = Force::kFractionBits + Impulse::kFractionBits - Velocity::kFractionBits;
    const auto kick = [a](const Node& of, int32_t mobility) {
      return int64_t{(*of.force)[a].raw()} * mobility;
    };
    const auto moving = [a](const Node& of, int32_t weight) {
      return int64_t{(*of.velocity)[a].raw()} * opaque(weight);
    };
    int64_t sum = int64_t{1} << (kShift - 1);
    sum += kick(node, node.mobility.raw());
    sum += moving(node, 1 << kShift);
    sum += kick(end0, -(end0.mobility.raw() >> 1));
    sum += moving(end0, -(1 << (kShift - 1)));
    sum += kick(end1, -(end1.mobility.raw() >> 1));
    sum += moving(end1, -(1 << (kShift - 1)));
    return Velocity::from_raw(integrate_detail::shifted_within<kShift>(sum));
  }
  /// d: positions are within +-4 edges, so the sum of two fits.
  [[nodiscard]] static Position offset(const Node& node, const Node& end0, const Node& end1, Eigen::Index a) {
    const int32_t ends = (*end0.position)[a].raw() + (*end1.position)[a].raw();
    return (*node.position)[a] - Position::from_raw((ends + 1) >> 1);
  }
  /// of_rate u + of_offset d
  static Velocity wanted(const Aim& aim, Velocity u, Position d) {
    constexpr int kShift = Position::kFractionBits + 31 - Velocity::kFractionBits;
    int64_t sum = int64_t{1} << (kShift - 1);
    sum += int64_t{u.raw()} * (aim.of_rate * (1 << (kShift - kRateBits)));
    sum += int64_t{d.raw()} * aim.of_offset.raw();
    return Velocity::from_raw(integrate_detail::shifted_within<kShift>(sum));
  }
  /// u / S, within the limit: the product's words one by one, times 2^room.
  static Force force_for(Velocity u, const Inverse& inverse) {
    constexpr int kShift = Velocity::kFractionBits + 30 - 32 + 4 - Force::kFractionBits;
    const int64_t product = int64_t{u.raw()} * inverse.mantissa.raw();
    const auto low = static_cast<uint32_t>(product);
    const auto high = static_cast<int32_t>(product >> 32);
    auto sum =
        static_cast<int64_t>((uint64_t{low} * static_cast<uint32_t>(opaque(inverse.two_to_room))) >> 32);
    sum += int64_t{1} << (kShift - 1);
    sum += int64_t{high} * opaque(inverse.two_to_room);
    return Force::from_raw(within_bits<kLimitBits>(integrate_detail::shifted_within<kShift>(sum)));
  }

  static constexpr int kRateBits = 16;
  static constexpr int kLimitBits = Force::kFractionBits;
  static_assert(kTetherForceLimit.raw() == 1 << (kLimitBits - 1));

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
  detail::Clamped clamped{0, 0};  // integrate_first counts it
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
