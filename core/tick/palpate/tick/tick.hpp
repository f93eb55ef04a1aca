// One tick: 1 ms of soft tissue.
//
//   touch      grasp the nearest node, or let go; the held node's target follows the tool; without a grasp
//              the tool's contact with the surface
//   remesh     within the profile's budgets: changes of the mesh in one tick of four, of the rotation front
//              in another one, and in the two between how urgent changes of the mesh are; beside that the one
//              before the mesh's chooses what it is to split, the one after it begins to draw what is to be
//              merged (schedule.hpp)
//   rotations  one extraction step a group, and one blending step; in every second tick misfits of an eighth
//              of the leaves
//   integrate  the driven node and held ends of tethers: how fast they will be moved
//   forces     corotated forces of all leaves; the last evaluation               } once a
//              also sees what the next rotations need                            } substep
//   integrate  the contact's force and tethers, then one step of symplectic Euler }
//              or, of held and driven nodes, towards where they must be in the end }
//   reaction   what the tissue does to the tool: the force on the driven node in the last substep, or the
//              contact's after its passivity controller
//
// A probe sees enter and leave of every stage; it may read a clock, and nothing it sees enters the state.
// The same state and input give the same bits on every machine.
#pragma once

#include "palpate/tick/remesh_stage.hpp"
#include "palpate/tick/schedule.hpp"
#include "palpate/tick/stage.hpp"

namespace palpate {
namespace tick_stages {

/// A tool that holds on to a node does not touch the surface beside it.
template <class Profile>
void touch_surface(State<Profile>& state, const Vector3<Position>& tool, bool has_tool) {
  if (!state.model.contact.is_on()) return;
  if (state.grasp.holds() || !has_tool) {
    state.contact.clear();
    return;
  }
  ContactStep<Profile>(state.forest, state.model.contact, state.candidates, state.contact).run(tool);
}

/// A look for a node to hold on to takes a contact's place in its tick, as a pass over all nodes of its own:
/// where none is in reach the contact stays for this tick as it was.
template <class Profile>
void take_hold(State<Profile>& state, const Vector3<Position>& tool) {
  close_grasp(state.forest, tool, state.model.grasp_reach, state.grasp);
  if (state.grasp.holds() && state.model.contact.is_on()) state.contact.clear();
}

template <class Profile>
PALPATE_NOINLINE void touch(State<Profile>& state, const TickInput& input) {
  const Vector3<Position> tool = within_position_limit(input.tool);
  const bool was_held = state.grasp.holds();
  if (opened_or_closes(state.forest, input.close_grasp && input.has_tool, state.grasp)) {
    take_hold(state, tool);
  } else {
    touch_surface(state, tool, input.has_tool);
  }
  state.driven.node = state.grasp.node;
  // Each within +-4 and +-8 edges: the sum fits Position.
  const Vector3<Position> goal = tool + state.grasp.offset;
  const Vector3<Position> target = within_position_limit(goal);
  const bool is_eased = state.model.contact.is_on() && was_held;
  state.driven.target = is_eased ? eased(state.driven.target, target) : target;
}

template <Slot Which, class Profile>
PALPATE_NOINLINE void remesh(State<Profile>& state) {
  if constexpr (Which == Slot::kMesh) {
    change_mesh(state);
  } else {
    state.tethers.advance(state.driven.node);
    if constexpr (Which == Slot::kFront) change_front(state);
    if constexpr (Which == Slot::kJudgement) {
      judge_mesh(state);
      if (slot_of(state.tick + 1) == Slot::kMesh) {
        choose_for_mesh(state);
      } else {
        draw_for_mesh(state);
      }
    }
  }
}

template <bool Judges, class Profile>
PALPATE_NOINLINE void rotations(State<Profile>& state) {
  update_rotations(state.front, state.groups);
  if constexpr (Judges) renew_misfits(state.forest, state.front, state.groups, state.misfits);
}

template <Observe Mode, class Profile>
PALPATE_NOINLINE void forces(State<Profile>& state) {
  GroupForces<Profile> forces(state.forest, state.front, state.groups, state.model.materials, state.frame);
  state.clamps.strain += forces.template evaluate<Mode>(state.solve.force_position);
}

template <class Profile>
PALPATE_NOINLINE void aim(State<Profile>& state, const TickInput& input) {
  aim_ends(state.forest, state.model.dynamics, input.hold_motion, state.driven, state.solve, state.tethers);
}

/// In the first substep of a tick held nodes and the driven one set out.
enum class Substep { kFirst, kNext };

template <Substep Which, class Profile>
PALPATE_NOINLINE void integrate(State<Profile>& state, const TickInput& input, uint32_t remaining) {
  const Dynamics& dynamics = state.model.dynamics;
  add_load(state.forest, state.contact.load, state.contact.force);
  add_tether_forces(state.forest, state.solve, state.tethers, dynamics.substeps, remaining,
                    state.driven.node);
  if constexpr (Which == Substep::kFirst) {
    integrate_first(state.forest, dynamics, input.hold_motion, state.driven, state.solve, state.clamps);
  } else {
    integrate_next(state.forest, dynamics, state.driven.node, state.solve, state.clamps);
  }
}

/// The flag of a tick for a reason why the fronts had to wait.
inline uint32_t waiting_flags(uint32_t waiting) {
  constexpr uint32_t kFirst = static_cast<uint32_t>(TickFlag::kPatchBudget);
  static_assert(
      kFirst * static_cast<uint32_t>(RemeshFlag::kTethers) == static_cast<uint32_t>(TickFlag::kTethersFull),
      "palpate: the flags of remesh stand side by side in those of the tick");
  return waiting * kFirst;
}

template <class Profile>
PALPATE_NOINLINE void reaction(State<Profile>& state, const TickInput& input, const ClampCounters& before,
                               TickOutput& output) {
  const Vector3<Force> asked =
      state.grasp.holds() ? state.forest.node.force[state.grasp.node] : state.contact.force;
  output.reaction = asked;
  if (state.model.contact.is_on()) {
    output.reaction =
        react(state.model.contact, asked, within_position_limit(input.tool), input.has_tool, state.reaction);
  }
  const auto flag = [&output](bool set, TickFlag which) {
    output.flags |= set ? static_cast<uint32_t>(which) : 0u;
  };
  output.flags = waiting_flags(state.waiting.all());
  flag(state.clamps.speed != before.speed, TickFlag::kSpeedClamped);
  flag(state.clamps.position != before.position, TickFlag::kPositionClamped);
  flag(state.clamps.strain != before.strain, TickFlag::kStrainClamped);
  flag(state.grasp.holds(), TickFlag::kGrasping);
  flag(state.contact.is_touching, TickFlag::kTouching);
  flag(!state.contact.is_certain, TickFlag::kContactsFull);
  flag(state.reaction.passivity.is_braking, TickFlag::kBraking);
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
  const auto take = [&](auto slot) {
    stage(CoreStage::kRemesh, [&] { tick_stages::remesh<slot.kValue>(state); });
    stage(CoreStage::kRotations, [&] { tick_stages::rotations<slot.kValue == Slot::kJudgement>(state); });
  };
  // A branch for the whole slot: what a bound adds up is then what one tick can have.
  switch (slot_of(state.tick)) {
    case Slot::kMesh:
      take(SlotIs<Slot::kMesh>{});
      break;
    case Slot::kFront:
      take(SlotIs<Slot::kFront>{});
      break;
    case Slot::kJudgement:
      take(SlotIs<Slot::kJudgement>{});
      break;
  }
  stage(CoreStage::kIntegrate, [&] { tick_stages::aim(state, input); });
  advance<Profile::kSubsteps>(
      state.model.dynamics,
      [&] { stage(CoreStage::kForces, [&] { tick_stages::forces<Observe::kNo>(state); }); },
      [&] { stage(CoreStage::kForces, [&] { tick_stages::forces<Observe::kYes>(state); }); },
      [&](uint32_t remaining) {
        stage(CoreStage::kIntegrate,
              [&] { tick_stages::integrate<tick_stages::Substep::kFirst>(state, input, remaining); });
      },
      [&](uint32_t remaining) {
        stage(CoreStage::kIntegrate,
              [&] { tick_stages::integrate<tick_stages::Substep::kNext>(state, input, remaining); });
      });
  stage(CoreStage::kReaction, [&] { tick_stages::reaction(state, input, before, output); });
  ++state.tick;
}

}  // namespace palpate
