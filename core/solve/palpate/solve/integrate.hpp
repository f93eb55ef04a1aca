// Symplectic Euler with lumped masses, one substep:
//   v += dt a - alpha_M dt v,  x += dt v
// and forces are evaluated at x + beta_K v, which is stiffness damping without a matrix. Held and grasped
// nodes go in a straight line to where they must be at the end of the tick and arrive exactly: in each
// substep they make the first of as many equal steps as are left.
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
  sum += int64_t{v.raw()} * as_factor(1 << kShift);
  sum += int64_t{drag.raw()} * as_factor(-(1 << kOfDrag));
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
