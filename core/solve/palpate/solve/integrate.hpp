// Symplectic Euler with lumped masses, one substep:
//   v += dt a - alpha_M dt v,  x += dt v
// and forces are evaluated at x + beta_K v, which is stiffness damping without a matrix. Held and grasped
// nodes go in a straight line to where they must be at the end of the tick and arrive exactly.
#pragma once

#include "palpate/mesh/forest.hpp"
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
  uint32_t speed;     // nodes faster than +-1/32 edge a substep
  uint32_t position;  // nodes beyond +-4 edges
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

/// v + f impulse - alpha_M dt v in one rounding, clamped to the range of Velocity.
inline Velocity next_velocity(Velocity v, Force f, Impulse impulse, Q<-5, 36> mass_damping,
                              uint32_t& clamped) {
  constexpr int kBits = Force::kFractionBits + Impulse::kFractionBits;
  const Acc<kBits> kick = f * impulse;
  const Acc<72> drag = v * mass_damping;
  const auto sum = widen<kBits>(v) + kick - Acc<kBits>::from_raw(drag.raw() >> (72 - kBits));
  const int64_t rounded = shift_right_rounded(sum.raw(), kBits - Velocity::kFractionBits);
  const int64_t limit = Velocity::max().raw();
  const int64_t low = rounded < -limit ? -limit : rounded;
  const int64_t within = low > limit ? limit : low;
  clamped |= within != rounded ? 1u : 0u;
  return Velocity::from_raw(static_cast<int32_t>(within));
}

inline Position moved(Position x, Velocity v, uint32_t& clamped) {
  constexpr int kShift = Velocity::kFractionBits - Position::kFractionBits;
  const Position next = x + Position::from_raw(static_cast<int32_t>(shift_right_rounded(v.raw(), kShift)));
  const Position within = clamp(next, -kPositionLimit, kPositionLimit);
  clamped |= static_cast<uint32_t>(next.raw() ^ within.raw());
  return within;
}

/// The velocity that covers 1 / remaining of the way to the target.
inline Velocity towards(Position x, Position target, Q<0, 31> fraction, uint32_t& clamped) {
  const Acc<58> step = (target - x) * fraction;
  const Velocity v = narrow_saturated<Velocity>(step);
  clamped |= v == Velocity::max() || v == Velocity::min() ? 1u : 0u;
  return v;
}

inline Position force_position(Position x, Velocity v, Q<0, 31> stiffness_damping) {
  return x + narrow<Position>(v * stiffness_damping);
}

/// 1 / n for n >= 2; 1 is not in the format, so the last substep places the node instead.
inline constexpr std::array<Q<0, 31>, kMaxSubsteps + 1> kFractions = {
    Q<0, 31>::max(),       Q<0, 31>::max(),       Q<0, 31>::ratio(1, 2),
    Q<0, 31>::ratio(1, 3), Q<0, 31>::ratio(1, 4), Q<0, 31>::ratio(1, 5),
    Q<0, 31>::ratio(1, 6), Q<0, 31>::ratio(1, 7), Q<0, 31>::ratio(1, 8)};

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

/// Moves all live nodes by one substep; `remaining` counts it: 1 in the last substep of a tick.
template <class Profile>
void integrate_substep(Forest<Profile>& forest, const Dynamics& dynamics, const HoldMotions& motions,
                       const DrivenNode& driven, uint32_t remaining, SolveState<Profile>& solve,
                       ClampCounters& counters) {
  namespace detail = integrate_detail;
  auto& state = forest.node;
  const Q<0, 31> fraction = detail::kFractions[remaining];
  for (const uint32_t i : bounded<Profile::kNodes>(forest.nodes.used(), [] {})) {
    const uint16_t node = forest.nodes.live(i);
    const NodeControl control = solve.control[node];
    const bool is_free = control == NodeControl::kFree && node != driven.node;
    Vector3<Position> target = driven.target;
    if (!is_free && node != driven.node) {
      target = within_position_limit(
          motions[control == NodeControl::kHeldByFirst ? 0 : 1](rest_position(state.rest[node])));
    }
    uint32_t too_fast = 0;
    uint32_t too_far = 0;
    Vector3<Position>& x = state.position[node];
    Vector3<Velocity>& v = state.velocity[node];
    for (const uint32_t axis : bounded<3>(3, [] {})) {
      const auto a = static_cast<Eigen::Index>(axis);
      if (is_free) {
        v[a] = detail::next_velocity(v[a], state.force[node][a], solve.impulse[node], dynamics.mass_damping,
                                     too_fast);
        x[a] = detail::moved(x[a], v[a], too_far);
      } else {
        v[a] = detail::towards(x[a], target[a], fraction, too_fast);
        x[a] = remaining == 1 && too_fast == 0 ? target[a] : detail::moved(x[a], v[a], too_far);
      }
      solve.force_position[node][a] = detail::force_position(x[a], v[a], dynamics.stiffness_damping);
    }
    counters.speed += too_fast != 0 ? 1u : 0u;
    counters.position += too_far != 0 ? 1u : 0u;
  }
}

/// All substeps of a tick. `forces()` must fill the nodes' forces at SolveState::force_position, as
/// `last_forces()`, which may also look at what changes only once a tick; `integrate(remaining)` runs one
/// substep. They are the caller's so that each can be a stage of its own.
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
