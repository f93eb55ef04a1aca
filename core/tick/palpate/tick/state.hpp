// Everything that changes from tick to tick, and what goes in and out. One static object; no pointers, no
// heap.
#pragma once

#include "palpate/elastic/group_forces.hpp"
#include "palpate/elastic/misfit_sweep.hpp"
#include "palpate/mesh/make_forest.hpp"
#include "palpate/remesh/urgency.hpp"
#include "palpate/solve/tether_force.hpp"
#include "palpate/tick/model.hpp"
#include "palpate/touch/contact.hpp"
#include "palpate/touch/grasp.hpp"
#include "palpate/touch/reaction.hpp"

namespace palpate {

/// Conditions of the last tick, one bit each.
enum class TickFlag : uint32_t {
  kSpeedClamped = 1u << 0,
  kPositionClamped = 1u << 1,
  kStrainClamped = 1u << 2,
  kGrasping = 1u << 3,
  // A change of the mesh or of the rotation front had to wait: what to raise.
  kPatchBudget = 1u << 4,
  kRotationBudget = 1u << 5,
  kLeavesFull = 1u << 6,
  kNodesFull = 1u << 7,
  kGroupsFull = 1u << 8,
  kTethersFull = 1u << 9,
  kTouching = 1u << 10,
  kContactsFull = 1u << 11,  // more faces of the surface within the tool than the profile looks at
  kBraking = 1u << 12,       // the passivity controller takes energy out
};

struct TickInput {
  Vector3<Position> tool;  // in the body's frame, cube edges
  bool close_grasp;
  HoldMotions hold_motion;  // where the held regions are at the end of this tick
  bool has_tool = true;     // without one `tool` counts for nothing and no grasp holds
};

struct TickOutput {
  Vector3<Force>
      reaction;    // what the tissue does to the tool, E_ref edge^2; zero without a grasp or a contact
  uint32_t flags;  // TickFlag bits
};

/// RemeshFlag bits of the last turns of both fronts, and of the last draws for merges.
struct TurnFlags {
  uint32_t mesh, front, draws;

  [[nodiscard]] constexpr uint32_t all() const { return mesh | front | draws; }
};

template <class Profile>
struct State {
  Model model;
  Forest<Profile> forest;
  RotationFront<Profile> front;
  Groups<Profile> groups;
  MisfitSweep misfits;
  GroupFrame<Profile> frame;  // scratch
  Urgencies<Profile> urgencies;
  Tethers<Profile> tethers;
  RemeshCounters remesh;
  TurnFlags waiting;
  SolveState<Profile> solve;
  Grasp grasp;
  DrivenNode driven;
  Candidates<Profile> candidates;  // scratch
  Contact contact;
  Reaction reaction;
  ClampCounters clamps;  // since start
  uint32_t tick;
};

enum class Status : uint8_t {
  kDone,
  kTooManyLeaves,
  kTooManyNodes,
  kTooManyGroups,
  kLevelTooDeep,         // of the start, or a region's finest one
  kLevelsContradictory,  // a region's range is empty, or the start's level is not in it
  kTooManySubsteps,
  kNoSuchCriterion  // the profile has no code for one of the model's criteria
};

/// Builds the mesh of `model` at rest. At boot, not in the cycle: O(leaves) patches.
template <class Profile>
[[nodiscard]] Status start(State<Profile>& state, const Model& model);

}  // namespace palpate

#include "palpate/tick/start.hpp"
