// One tick: 1 ms of soft tissue.
//
//   touch      grasp the nearest node, or let go; the held node's target follows the tool
//   rotations  one extraction step a group, from the positions as they are
//   forces     corotated forces of all leaves        } once a
//   integrate  one step of symplectic Euler          } substep
//   reaction   what the tissue does to the tool: the force on the driven node in the last substep
//
// A probe sees enter and leave of every stage; it may read a clock, and nothing it sees enters the state.
// The same state and input give the same bits on every machine.
#pragma once

#include "palpate/tick/stage.hpp"
#include "palpate/tick/state.hpp"

namespace palpate {
namespace tick_stages {

template <class Profile>
PALPATE_NOINLINE void touch(State<Profile>& state, const TickInput& input) {
  const Vector3<Position> tool = within_position_limit(input.tool);
  update_grasp(state.forest, tool, input.close_grasp, state.model.grasp_reach, state.grasp);
  state.driven.node = state.grasp.node.index;
  // Each within +-4 and +-8 edges: the sum fits Position.
  const Vector3<Position> target = tool + state.grasp.offset;
  state.driven.target = within_position_limit(target);
}

template <class Profile>
PALPATE_NOINLINE void rotations(State<Profile>& state) {
  update_rotations(state.forest, state.groups);
}

template <class Profile>
PALPATE_NOINLINE void forces(State<Profile>& state) {
  state.clamps.strain +=
      evaluate_forces(state.forest, state.groups, state.model.materials, state.solve.force_position);
}

template <class Profile>
PALPATE_NOINLINE void integrate(State<Profile>& state, const TickInput& input, uint32_t remaining) {
  integrate_substep(state.forest, state.model.dynamics, input.hold_motion, state.driven, remaining,
                    state.solve, state.clamps);
}

template <class Profile>
PALPATE_NOINLINE void reaction(const State<Profile>& state, const ClampCounters& before, TickOutput& output) {
  output.reaction = zero_vector<Force>();
  if (state.grasp.holds()) output.reaction = state.forest.node.force[state.grasp.node.index];
  const auto flag = [&output](bool set, TickFlag which) {
    output.flags |= set ? static_cast<uint32_t>(which) : 0u;
  };
  output.flags = 0;
  flag(state.clamps.speed != before.speed, TickFlag::kSpeedClamped);
  flag(state.clamps.position != before.position, TickFlag::kPositionClamped);
  flag(state.clamps.strain != before.strain, TickFlag::kStrainClamped);
  flag(state.grasp.holds(), TickFlag::kGrasping);
}

}  // namespace tick_stages

template <class Profile, class Probe>
void tick(State<Profile>& state, const TickInput& input, TickOutput& output, Probe& probe) {
  const ClampCounters before = state.clamps;
  const auto stage = [&probe](CoreStage which, auto&& run) {
    probe.enter(which);
    run();
    probe.leave(which);
  };
  stage(CoreStage::kTouch, [&] { tick_stages::touch(state, input); });
  stage(CoreStage::kRotations, [&] { tick_stages::rotations(state); });
  advance(
      state.model.dynamics, [&] { stage(CoreStage::kForces, [&] { tick_stages::forces(state); }); },
      [&](uint32_t remaining) {
        stage(CoreStage::kIntegrate, [&] { tick_stages::integrate(state, input, remaining); });
      });
  stage(CoreStage::kReaction, [&] { tick_stages::reaction(state, before, output); });
  ++state.tick;
}

}  // namespace palpate
