// Everything that changes from tick to tick, and what goes in and out. One static object; no pointers, no
// heap.
#pragma once

#include "palpate/elastic/groups.hpp"
#include "palpate/mesh/make_forest.hpp"
#include "palpate/tick/model.hpp"
#include "palpate/touch/grasp.hpp"

namespace palpate {

/// Conditions of the last tick, one bit each.
enum class TickFlag : uint32_t {
  kSpeedClamped = 1u << 0,
  kPositionClamped = 1u << 1,
  kStrainClamped = 1u << 2,
  kGrasping = 1u << 3,
};

struct TickInput {
  Vector3<Position> tool;  // in the body's frame, cube edges
  bool close_grasp;
  HoldMotions hold_motion;  // where the held regions are at the end of this tick
};

struct TickOutput {
  Vector3<Force> reaction;  // what the tissue does to the tool, E_ref edge^2; zero without a grasp
  uint32_t flags;           // TickFlag bits
};

template <class Profile>
struct State {
  Model model;
  Forest<Profile> forest;
  Groups<Profile> groups;
  SolveState<Profile> solve;
  Grasp grasp;
  DrivenNode driven;
  ClampCounters clamps;  // since start
  uint32_t tick;
};

enum class Status : uint8_t { kDone, kTooManyLeaves, kTooManyNodes, kTooManyGroups, kLevelTooDeep };

/// Builds the mesh of `model` at rest. At boot, not in the cycle: O(leaves) patches.
template <class Profile>
[[nodiscard]] Status start(State<Profile>& state, const Model& model);

}  // namespace palpate

#include "palpate/tick/start.hpp"
