// Symplectic Euler with lumped masses, one substep:
//   v += dt a - alpha_M dt v,  x += dt v
// and forces are evaluated at x + beta_K v, which is stiffness damping without a matrix. Held and grasped
// nodes go in a straight line to where they must be at the end of the tick and arrive exactly.
#pragma once

#include "palpate/mesh/forest.hpp"
#include "palpate/numeric/high_word.hpp"
#include "palpate/solve/dynamics.hpp"

namespace palpate {

/// Regions of the rest shape whose nodes are moved, not simulated.
inline constexpr uint32_t kHolds = 2;
using HeldRegions = std::array<LatticeBox, kHolds>;
using HoldMotions = std::array<RigidMotion, kHolds>;

/// Who moves a node.
enum class NodeControl : uint8_t { kFree, kHeldByFirst, kHeldBySecond };

/// A node that follows the tool.
struct DrivenNode {
  uint16_t node;  // kNone: nobody
  Vector3<Position> target;
};

struct ClampCounters {
  uint32_t speed;     // substeps in which a node was faster than +-1/32 edge a substep
  uint32_t position;  // substeps in which a node was beyond +-4 edges
  uint32_t strain;    // leaves beyond the strain or stress limit
};

template <class Profile>
struct SolveState {
  std::array<NodeControl, Profile::kNodes> control;
  std::array<Impulse, Profile::kNodes> impulse;
  std::array<Vector3<Position>, Profile::kNodes> force_position;  // x + beta_K v
};

/// By its place on the lattice, never by its neighbours.
inline NodeControl control_of(LatticePoint rest, const HeldRegions& held) {
  if (held[0].contains(rest)) return NodeControl::kHeldByFirst;
  if (held[1].contains(rest)) return NodeControl::kHeldBySecond;
  return NodeControl::kFree;
}

namespace integrate_detail {

/// A number that the compiler takes as it comes, so that it multiplies by a power of two in the instruction
/// that adds, instead of shifting a register pair.
PALPATE_ALWAYS_INLINE int32_t as_factor(int32_t value) {
#ifdef PALPATE_TARGET
  asm("" : "+r"(value));
#endif
  return value;
}

/// v + f impulse - alpha_M dt v, within the range of Velocity: the upper half of what is beyond becomes the
/// limit's, so its error is 2^-16 of it.
PALPATE_ALWAYS_INLINE Velocity next_velocity(Velocity v, Force f, Impulse impulse, Q<-5, 36> mass_damping,
                                             uint32_t& clamped) {
  using Drag = Q<-9, 40>;
  constexpr int kBits = Force::kFractionBits + Impulse::kFractionBits;
  constexpr int kShift = kBits - Velocity::kFractionBits;
  constexpr int kOfDrag = kBits - Drag::kFractionBits;
  // Of the drag half an LSB of the velocity is taken, which rounds the sum.
  const Drag drag = multiply_add_high(v, mass_damping, Drag::from_raw(-(1 << (kShift - 1 - kOfDrag))));
  int64_t sum = int64_t{f.raw()} * impulse.raw();
  sum += int64_t{v.raw()} * as_factor(1 << kShift);
  sum += int64_t{drag.raw()} * as_factor(-(1 << kOfDrag));
  const auto high = static_cast<int32_t>(sum >> 32);
  const int32_t within = within_bits<kShift>(high);
  clamped |= static_cast<uint32_t>(high ^ within);
  const uint32_t low = static_cast<uint32_t>(sum) >> kShift;
  return Velocity::from_raw(static_cast<int32_t>((static_cast<uint32_t>(within) << (32 - kShift)) | low));
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

/// Below 0 where it is so, else not: two of them make one branch, or none.
PALPATE_ALWAYS_INLINE int32_t sign_if_free(NodeControl control) { return static_cast<int32_t>(control) - 1; }
PALPATE_ALWAYS_INLINE int32_t sign_if_equal(uint16_t a, uint16_t b) { return (a ^ b) - 1; }
/// All ones for a node that nothing moves but forces, else 0.
PALPATE_ALWAYS_INLINE int32_t mask_if_free(NodeControl control, uint16_t node, uint16_t driven) {
  return (sign_if_free(control) & ~sign_if_equal(node, driven)) >> 31;
}

/// 1 / n; 1 is not in the format.
inline constexpr std::array<Q<0, 31>, kMaxSubsteps + 1> kFractions = {
    Q<0, 31>::max(),       Q<0, 31>::max(),       Q<0, 31>::ratio(1, 2),
    Q<0, 31>::ratio(1, 3), Q<0, 31>::ratio(1, 4), Q<0, 31>::ratio(1, 5),
    Q<0, 31>::ratio(1, 6), Q<0, 31>::ratio(1, 7), Q<0, 31>::ratio(1, 8)};

/// Sets out from x to the target: `steps` steps, each of whole LSBs, so what rounding would leave in the end
/// is taken off x now. A target that is too far is not reached.
PALPATE_ALWAYS_INLINE void aim(Vector3<Position>& x, Vector3<Velocity>& v, const Vector3<Position>& target,
                               uint32_t steps, uint32_t& clamped) {
  constexpr int kShift = Velocity::kFractionBits - Position::kFractionBits;
  struct Start {
    int32_t x, v;
  };
  const Q<0, 31> fraction = kFractions[steps];
  const auto start = [&](Eigen::Index axis) {
    const int32_t from = x[axis].raw();
    const auto twice = Q<3, 28>::from_raw(2 * (target[axis].raw() - from));
    const int32_t step = multiply_high<Position>(twice, fraction).raw();
    const int32_t within = within_bits<32 - kShift>(step);
    clamped |= static_cast<uint32_t>(step ^ within);
    const int32_t is_near = ((step ^ within) - 1) >> 31;  // without a branch: a clamp keeps the sign
    const int32_t taken_off = target[axis].raw() - static_cast<int32_t>(steps) * within - from;
    return Start{from + (taken_off & is_near), static_cast<int32_t>(static_cast<uint32_t>(within) << kShift)};
  };
  // All is loaded before any is stored: a load may have to wait for a store.
  const Start s0 = start(0), s1 = start(1), s2 = start(2);
  x[0] = Position::from_raw(s0.x);
  x[1] = Position::from_raw(s1.x);
  x[2] = Position::from_raw(s2.x);
  v[0] = Velocity::from_raw(s0.v);
  v[1] = Velocity::from_raw(s1.v);
  v[2] = Velocity::from_raw(s2.v);
}

}  // namespace integrate_detail

/// Control, impulse and force position of a node that is new.
template <class Profile>
void start_node(const Forest<Profile>& forest, const Dynamics& dynamics, const HeldRegions& held,
                uint16_t node, SolveState<Profile>& solve) {
  solve.control[node] = control_of(forest.node.rest[node], held);
  solve.impulse[node] = impulse_of(dynamics, forest.node.mass[node]);
  // As its edge's ends have it: it starts halfway between theirs, and the split changes no force.
  for (const uint32_t axis : bounded<3>(3, [] {})) {
    const auto a = static_cast<Eigen::Index>(axis);
    solve.force_position[node][a] = integrate_detail::force_position(
        forest.node.position[node][a], forest.node.velocity[node][a], dynamics.stiffness_damping);
  }
}

/// Of every live node. At boot.
template <class Profile>
void start_solve(const Forest<Profile>& forest, const Dynamics& dynamics, const HeldRegions& held,
                 SolveState<Profile>& solve) {
  for (const uint32_t i : bounded<Profile::kNodes>(forest.nodes.used(), [] {})) {
    start_node(forest, dynamics, held, forest.nodes.live(i), solve);
  }
}

/// Once a tick, before its substeps: held and driven nodes set out to where they must be at its end.
template <class Profile>
void aim_moved_nodes(Forest<Profile>& forest, const Dynamics& dynamics, const HoldMotions& motions,
                     const DrivenNode& driven, const SolveState<Profile>& solve, ClampCounters& counters) {
  auto& state = forest.node;
  const uint32_t steps = dynamics.substeps;
  uint32_t too_fast = 0;
  for (const uint32_t i : bounded<Profile::kNodes>(forest.nodes.used(), [] {})) {
    const uint16_t node = forest.nodes.live(i);
    const NodeControl control = solve.control[node];
    if ((integrate_detail::sign_if_free(control) | integrate_detail::sign_if_equal(node, driven.node)) < 0) {
      continue;
    }
    const RigidMotion& motion = motions[control == NodeControl::kHeldByFirst ? 0 : 1];
    const Vector3<Position> target = motion(state.rest[node]);
    integrate_detail::aim(state.position[node], state.velocity[node], within_position_limit(target), steps,
                          too_fast);
  }
  if (driven.node != kNone) {
    integrate_detail::aim(state.position[driven.node], state.velocity[driven.node], driven.target, steps,
                          too_fast);
  }
  counters.speed += too_fast != 0 ? 1u : 0u;
}

/// Moves all live nodes by one substep. Nothing accelerates those that were aimed.
template <class Profile>
void integrate_substep(Forest<Profile>& forest, const Dynamics& dynamics, uint16_t driven,
                       SolveState<Profile>& solve, ClampCounters& counters) {
  namespace detail = integrate_detail;
  auto& state = forest.node;
  const auto mass_damping = dynamics.mass_damping;
  const auto stiffness_damping = dynamics.stiffness_damping;
  uint32_t too_fast = 0;
  uint32_t too_far = 0;
  for (const uint32_t i : bounded<Profile::kNodes>(forest.nodes.used(), [] {})) {
    const uint16_t node = forest.nodes.live(i);
    const int32_t if_free = detail::mask_if_free(solve.control[node], node, driven);
    const auto impulse = Impulse::from_raw(solve.impulse[node].raw() & if_free);
    const auto damping = Q<-5, 36>::from_raw(mass_damping.raw() & if_free);
    Vector3<Velocity>& v = state.velocity[node];
    const Vector3<Force>& f = state.force[node];
    Vector3<Position>& x = state.position[node];
    Vector3<Position>& force_x = solve.force_position[node];
    const auto next_v = [&](Eigen::Index axis) {
      return detail::next_velocity(v[axis], f[axis], impulse, damping, too_fast);
    };
    const auto ahead = [&](Position at, Velocity with) {
      return detail::force_position(at, with, stiffness_damping);
    };
    // All is loaded before any is stored: a load may have to wait for a store.
    const Velocity v0 = next_v(0), v1 = next_v(1), v2 = next_v(2);
    const Position x0 = detail::moved(x[0], v0, too_far);
    const Position x1 = detail::moved(x[1], v1, too_far);
    const Position x2 = detail::moved(x[2], v2, too_far);
    v[0] = v0;
    v[1] = v1;
    v[2] = v2;
    x[0] = x0;
    x[1] = x1;
    x[2] = x2;
    force_x[0] = ahead(x0, v0);
    force_x[1] = ahead(x1, v1);
    force_x[2] = ahead(x2, v2);
  }
  counters.speed += too_fast != 0 ? 1u : 0u;
  counters.position += too_far != 0 ? 1u : 0u;
}

/// All substeps of a tick. `forces()` must fill the nodes' forces at SolveState::force_position, as
/// `last_forces()`, which may also look at what changes only once a tick; `integrate(remaining)` runs one
/// substep, 1 the last. They are the caller's so that each can be a stage of its own.
template <uint32_t MostSubsteps, class Forces, class LastForces, class Integrate>
PALPATE_ALWAYS_INLINE void advance(const Dynamics& dynamics, Forces&& forces, LastForces&& last_forces,
                                   Integrate&& integrate) {
  for (const uint32_t substep : bounded<MostSubsteps - 1>(dynamics.substeps - 1u, [] {})) {
    forces();
    integrate(dynamics.substeps - substep);
  }
  last_forces();
  integrate(1);
}

}  // namespace palpate
