// Symplectic Euler with lumped masses, one substep:
//   v += dt a - alpha_M dt v,  x += dt v
// and forces are evaluated at x + beta_K v, which is stiffness damping without a matrix. Held and grasped
// nodes go in a straight line to where they must be at the end of the tick and arrive exactly: in each
// substep they make the first of as many equal steps as are left.
#pragma once

#include "palpate/solve/node_step.hpp"

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

/// Below 0 where it is so, else not: two of them make one branch, or none.
PALPATE_ALWAYS_INLINE int32_t sign_if_free(NodeControl control) { return static_cast<int32_t>(control) - 1; }
PALPATE_ALWAYS_INLINE int32_t sign_if_equal(uint16_t a, uint16_t b) { return (a ^ b) - 1; }
/// All ones for a node that nothing moves but forces, else 0.
PALPATE_ALWAYS_INLINE int32_t mask_if_free(NodeControl control, uint16_t node, uint16_t driven) {
  return (sign_if_free(control) & ~sign_if_equal(node, driven)) >> 31;
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

/// Where held nodes must be at the end of the tick.
template <class Profile>
[[nodiscard]] PALPATE_ALWAYS_INLINE Vector3<Position> held_target(const Forest<Profile>& forest,
                                                                  const HoldMotions& motions,
                                                                  NodeControl control, uint16_t node) {
  const RigidMotion& motion = motions[control == NodeControl::kHeldByFirst ? 0 : 1];
  return within_position_limit(motion(forest.node.rest[node]));
}

namespace integrate_detail {

/// Where a node is after a substep, and where its forces are evaluated then.
template <class Profile>
PALPATE_ALWAYS_INLINE void put(const Next& next, uint16_t node, Q<0, 31> stiffness_damping,
                               Forest<Profile>& forest, SolveState<Profile>& solve) {
  Vector3<Velocity>& v = forest.node.velocity[node];
  Vector3<Position>& x = forest.node.position[node];
  Vector3<Position>& force_x = solve.force_position[node];
  v[0] = next.v0;
  v[1] = next.v1;
  v[2] = next.v2;
  x[0] = next.x0;
  x[1] = next.x1;
  x[2] = next.x2;
  force_x[0] = force_position(next.x0, next.v0, stiffness_damping);
  force_x[1] = force_position(next.x1, next.v1, stiffness_damping);
  force_x[2] = force_position(next.x2, next.v2, stiffness_damping);
}

inline void count(const Clamped& clamped, ClampCounters& counters) {
  counters.speed += clamped.speed != 0 ? 1u : 0u;
  counters.position += clamped.position != 0 ? 1u : 0u;
}

/// What the driven node has while the loop over nodes is to leave it where it is.
struct Apart {
  Impulse impulse;
  NodeControl control;
};

template <class Profile>
PALPATE_ALWAYS_INLINE Apart set_apart(uint16_t node, Forest<Profile>& forest, SolveState<Profile>& solve) {
  const Apart apart{solve.impulse[node], solve.control[node]};
  solve.impulse[node] = Impulse::from_raw(0);
  solve.control[node] = NodeControl::kFree;
  forest.node.velocity[node] = zero_vector<Velocity>();
  return apart;
}

template <class Profile>
PALPATE_ALWAYS_INLINE void take_back(const Apart& apart, uint16_t node, SolveState<Profile>& solve) {
  solve.impulse[node] = apart.impulse;
  solve.control[node] = apart.control;
}

}  // namespace integrate_detail

/// Moves all live nodes by the first substep of a tick: held nodes and the driven one make the first of equal
/// steps to where they must be at its end.
template <class Profile>
PALPATE_ALWAYS_INLINE void integrate_first(Forest<Profile>& forest, const Dynamics& dynamics,
                                           const HoldMotions& motions, const DrivenNode& driven,
                                           SolveState<Profile>& solve, ClampCounters& counters) {
  namespace detail = integrate_detail;
  constexpr bool kIsOnly = Profile::kSubsteps == 1;
  const uint32_t steps = dynamics.substeps;
  const auto& state = forest.node;
  const auto mass_damping = dynamics.mass_damping;
  const auto stiffness_damping = dynamics.stiffness_damping;
  detail::Clamped clamped{0, 0};
  const bool is_driving = driven.node != kNone;
  detail::Apart apart{};
  if (is_driving) apart = detail::set_apart(driven.node, forest, solve);
  for (const uint32_t i : bounded<Profile::kNodes>(forest.nodes.used(), [] {})) {
    const uint16_t node = forest.nodes.live(i);
    const NodeControl control = solve.control[node];
    // All is loaded before any is stored: a load may have to wait for a store.
    detail::Next next;
    if (control == NodeControl::kFree) {
      next = detail::accelerated(state.position[node], state.velocity[node], state.force[node],
                                 solve.impulse[node], mass_damping, clamped);
    } else {
      next = detail::led_towards<kIsOnly>(held_target(forest, motions, control, node), state.position[node],
                                          steps, clamped);
    }
    detail::put(next, node, stiffness_damping, forest, solve);
  }
  if (is_driving) {
    detail::take_back(apart, driven.node, solve);
    const auto next =
        detail::led_towards<kIsOnly>(driven.target, state.position[driven.node], steps, clamped);
    detail::put(next, driven.node, stiffness_damping, forest, solve);
  }
  detail::count(clamped, counters);
}

/// The same by one that is not the first: nothing accelerates those that have set out, so that one formula
/// does for all.
template <class Profile>
PALPATE_ALWAYS_INLINE void integrate_next(Forest<Profile>& forest, const Dynamics& dynamics, uint16_t driven,
                                          SolveState<Profile>& solve, ClampCounters& counters) {
  namespace detail = integrate_detail;
  const auto& state = forest.node;
  const auto mass_damping = dynamics.mass_damping;
  const auto stiffness_damping = dynamics.stiffness_damping;
  detail::Clamped clamped{0, 0};
  for (const uint32_t i : bounded<Profile::kNodes>(forest.nodes.used(), [] {})) {
    const uint16_t node = forest.nodes.live(i);
    const int32_t if_free = detail::mask_if_free(solve.control[node], node, driven);
    const auto impulse = Impulse::from_raw(solve.impulse[node].raw() & if_free);
    const auto damping = Q<-5, 36>::from_raw(mass_damping.raw() & if_free);
    const auto next = detail::accelerated(state.position[node], state.velocity[node], state.force[node],
                                          impulse, damping, clamped);
    detail::put(next, node, stiffness_damping, forest, solve);
  }
  detail::count(clamped, counters);
}

/// All substeps of a tick. `forces()` must fill the nodes' forces at SolveState::force_position, as
/// `last_forces()`, which may also look at what changes only once a tick; `integrate_first(remaining)` and
/// `integrate_next(remaining)` run one substep, 1 the last. They are the caller's so that each can be a stage
/// of its own.
template <uint32_t MostSubsteps, class Forces, class LastForces, class First, class Next>
PALPATE_ALWAYS_INLINE void advance(const Dynamics& dynamics, Forces&& forces, LastForces&& last_forces,
                                   First&& integrate_first, Next&& integrate_next) {
  if constexpr (MostSubsteps == 1) {
    last_forces();
    integrate_first(1);
  } else {
    const uint32_t substeps = dynamics.substeps;
    auto first = bounded_total<1>([] {});
    const auto integrate = [&](uint32_t remaining) {
      for ([[maybe_unused]] const uint32_t i : first.take(0, remaining == substeps ? 1 : 0)) {
        integrate_first(remaining);
        return;
      }
      integrate_next(remaining);
    };
    for (const uint32_t substep : bounded<MostSubsteps - 1>(substeps - 1, [] {})) {
      forces();
      integrate(substeps - substep);
    }
    last_forces();
    integrate(1);
  }
}

}  // namespace palpate
