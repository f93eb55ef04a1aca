// Where what is in a cycle's state, as a number that two builds compare before one takes the bytes of the
// other. All members are integers of fixed sizes, without pointers, so machines that align 64 bits to 8 bytes
// have the same layout; a test compiles it for x86-64 and for a Cortex-M.
#pragma once

#include "palpate/firmware/cycle_state.hpp"

namespace palpate::firmware {

namespace layout_detail {

/// FNV-1a's step over all of them.
template <class... Numbers>
constexpr uint64_t mixed(Numbers... numbers) {
  uint64_t hash = 0xcbf29ce484222325;
  ((hash = (hash ^ static_cast<uint64_t>(numbers)) * 0x100000001b3), ...);
  return hash;
}

template <class Profile>
constexpr uint64_t of_core() {
  using S = State<Profile>;
  static_assert(std::is_standard_layout_v<S> && std::is_trivially_destructible_v<S>);
  return mixed(sizeof(S), alignof(S), offsetof(S, model), offsetof(S, forest), offsetof(S, front),
               offsetof(S, groups), offsetof(S, frame), offsetof(S, urgencies), offsetof(S, tethers),
               offsetof(S, remesh), offsetof(S, waiting), offsetof(S, solve), offsetof(S, grasp),
               offsetof(S, driven), offsetof(S, contact), sizeof(S::contact), offsetof(S, clamps),
               offsetof(S, tick));
}

template <class Profile>
constexpr uint64_t of_mesh() {
  using F = Forest<Profile>;
  using G = Groups<Profile>;
  using R = RotationFront<Profile>;
  return mixed(sizeof(F), sizeof(Leaf), sizeof(F::pairs), sizeof(F::nodes), sizeof(F::node),
               offsetof(F, leaf), offsetof(F, pairs), offsetof(F, nodes), offsetof(F, node), sizeof(G),
               offsetof(G, extracted), offsetof(G, used), offsetof(G, blend), offsetof(G, gradient),
               sizeof(R), offsetof(R, groups), offsetof(R, tet), offsetof(R, partner),
               sizeof(SolveState<Profile>), sizeof(Tether), sizeof(Urgencies<Profile>));
}

inline constexpr uint64_t kOfSafety = mixed(
    sizeof(safety::Safety), offsetof(safety::Safety, state), offsetof(safety::Safety, raised),
    offsetof(safety::Safety, seen), offsetof(safety::Safety, ramp), offsetof(safety::Safety, force),
    offsetof(safety::Safety, velocity), offsetof(safety::Safety, encoders), offsetof(safety::Safety, timing),
    offsetof(safety::Safety, motors), sizeof(safety::Parameters), sizeof(safety::WarmMotor));

}  // namespace layout_detail

/// Of sizes and offsets.
template <class Profile>
constexpr uint64_t layout_fingerprint() {
  using C = CycleState<Profile>;
  static_assert(std::is_standard_layout_v<C> && std::is_trivially_destructible_v<C>,
                "palpate: a state is plain bytes. Eigen's matrices have copy constructors, but they copy the "
                "elements and nothing else");
  return layout_detail::mixed(
      sizeof(C), alignof(C), offsetof(C, core), offsetof(C, scene), offsetof(C, counts_at_reset),
      offsetof(C, posture), offsetof(C, input), offsetof(C, output), offsetof(C, force), offsetof(C, safety),
      offsetof(C, invariants), offsetof(C, is_setting_refused), offsetof(C, amplifiers_enabled),
      offsetof(C, motor_codes), offsetof(C, code_history), offsetof(C, peak_force_square),
      offsetof(C, flags_seen), offsetof(C, tethers_full_ticks), offsetof(C, fault),
      layout_detail::of_core<Profile>(), layout_detail::of_mesh<Profile>(), layout_detail::kOfSafety);
}

}  // namespace palpate::firmware
