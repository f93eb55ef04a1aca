// start() of state.hpp.
#pragma once

#include "palpate/tick/state.hpp"

namespace palpate {

template <class Profile>
Status start(State<Profile>& state, const Model& model) {
  state.model = model;
  state.grasp = Grasp::open();
  state.driven = DrivenNode{kNone, zero_vector<Position>()};
  state.clamps = ClampCounters{0, 0, 0};
  state.tick = 0;
  if (model.level > Profile::kMaxLevel) return Status::kLevelTooDeep;
  MeshStatus mesh = make_roots(state.forest, model.block, model.region_density);
  if (mesh == MeshStatus::kDone) mesh = refine_uniformly(state.forest, model.level);
  if (mesh == MeshStatus::kNodesFull) return Status::kTooManyNodes;
  if (mesh != MeshStatus::kDone) return Status::kTooManyLeaves;
  const RotationRules& rotation = model.remesh.rotation;
  const uint8_t level = rotation.criterion == RotationCriterion::kFull ? kDeepestLevel : rotation.start_level;
  if (!make_groups(state.forest, state.front, level)) return Status::kTooManyGroups;
  start_groups(state.front, state.groups);
  state.urgencies.clear();
  state.tethers.clear();
  state.remesh = RemeshCounters{};
  state.waiting = 0;
  start_solve(state.forest, model.dynamics, model.held, state.solve);
  return Status::kDone;
}

}  // namespace palpate
