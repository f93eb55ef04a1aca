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
  const Drag drag = multiply_high<Drag>(v, mass_damping);
  int64_t sum = int64_t{f.raw()} * impulse.raw();
  sum += int64_t{v.raw()} * as_factor(1 << kShift);
  sum += int64_t{drag.raw()} * as_factor(-(1 << (kBits - Drag::kFractionBits)));
  sum += int64_t{1} << (kShift - 1);
  const auto high = static_cast<int32_t>(sum >> 32);
  const int32_t within = within_bits<kShift>(high);
  clamped |= static_cast<uint32_t>(high ^ within);
  const uint32_t low = static_cast<uint32_t>(sum) >> kShift;
  return Velocity::from_raw(static_cast<int32_t>((static_cast<uint32_t>(within) << (32 - kShift)) | low));
}

PALPATE_ALWAYS_INLINE Position moved(Position x, Velocity v, uint32_t& clamped) {
  constexpr int kShift = Velocity::kFractionBits - Position::kFractionBits;
  // Rounded behind the shift: the fastest node's velocity has no room for it before.
  const int32_t next = x.raw() + (((v.raw() >> (kShift - 1)) + 1) >> 1);
  const int32_t within = within_bits<kPositionBits>(next);
  clamped |= static_cast<uint32_t>(next ^ within);
  return Position::from_raw(within);
}

/// x + beta_K v
PALPATE_ALWAYS_INLINE Position force_position(Position x, Velocity v, Q<0, 31> stiffness_damping) {
  using Ahead = Q<-4, 35>;
  constexpr int kShift = Ahead::kFractionBits - Position::kFractionBits;
  const Ahead ahead = multiply_high<Ahead>(v, stiffness_damping);
  return Position::from_raw(
      within_bits<kPositionBits>(x.raw() + ((ahead.raw() + (1 << (kShift - 1))) >> kShift)));
}

/// 1 / n; 1 is not in the format.
inline constexpr std::array<Q<0, 31>, kMaxSubsteps + 1> kFractions = {
    Q<0, 31>::max(),       Q<0, 31>::max(),       Q<0, 31>::ratio(1, 2),
    Q<0, 31>::ratio(1, 3), Q<0, 31>::ratio(1, 4), Q<0, 31>::ratio(1, 5),
    Q<0, 31>::ratio(1, 6), Q<0, 31>::ratio(1, 7), Q<0, 31>::ratio(1, 8)};

/// Sets out from x to the target: `steps` steps, each of whole LSBs, so what rounding would leave in the end
/// is taken off x now. A target that is too far is not reached.
inline void aim(Position& x, Velocity& v, Position target, uint32_t steps, uint32_t& clamped) {
  constexpr int kShift = Velocity::kFractionBits - Position::kFractionBits;
  const auto twice = Q<3, 28>::from_raw(2 * (target - x).raw());
  const int32_t step = multiply_high<Position>(twice, kFractions[steps]).raw();
  const int32_t within = within_bits<32 - kShift>(step);
  clamped |= static_cast<uint32_t>(step ^ within);
  v = Velocity::from_raw(static_cast<int32_t>(static_cast<uint32_t>(within) << kShift));
  const int32_t from = target.raw() - static_cast<int32_t>(steps) * within;
  x = within == step ? Position::from_raw(from) : x;
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
  uint32_t too_fast = 0;
  const auto aim = [&](uint16_t node, const Vector3<Position>& target) {
    const auto along = [&](Eigen::Index axis) {
      integrate_detail::aim(state.position[node][axis], state.velocity[node][axis], target[axis],
                            dynamics.substeps, too_fast);
    };
    along(0);
    along(1);
    along(2);
  };
  for (const uint32_t i : bounded<Profile::kNodes>(forest.nodes.used(), [] {})) {
    const uint16_t node = forest.nodes.live(i);
    const NodeControl control = solve.control[node];
    if (control == NodeControl::kFree || node == driven.node) continue;
    const RigidMotion& motion = motions[control == NodeControl::kHeldByFirst ? 0 : 1];
    aim(node, within_position_limit(motion(rest_position(state.rest[node]))));
  }
  if (driven.node != kNone) aim(driven.node, driven.target);
  counters.speed += too_fast != 0 ? 1u : 0u;
}

/// Moves all live nodes by one substep. Nothing accelerates those that were aimed.
template <class Profile>
void integrate_substep(Forest<Profile>& forest, const Dynamics& dynamics, uint16_t driven,
                       SolveState<Profile>& solve, ClampCounters& counters) {
  namespace detail = integrate_detail;
  auto& state = forest.node;
  uint32_t too_fast = 0;
  uint32_t too_far = 0;
  for (const uint32_t i : bounded<Profile::kNodes>(forest.nodes.used(), [] {})) {
    const uint16_t node = forest.nodes.live(i);
    const bool is_free = solve.control[node] == NodeControl::kFree && node != driven;
    const int32_t if_free = is_free ? -1 : 0;
    const auto impulse = Impulse::from_raw(solve.impulse[node].raw() & if_free);
    const auto damping = Q<-5, 36>::from_raw(dynamics.mass_damping.raw() & if_free);
    const auto along = [&](Eigen::Index axis) {
      Velocity& v = state.velocity[node][axis];
      Position& x = state.position[node][axis];
      v = detail::next_velocity(v, state.force[node][axis], impulse, damping, too_fast);
      x = detail::moved(x, v, too_far);
      solve.force_position[node][axis] = detail::force_position(x, v, dynamics.stiffness_damping);
    };
    along(0);
    along(1);
    along(2);
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
