// start() of state.hpp.
#pragma once

#include "palpate/tick/state.hpp"

namespace palpate {
namespace start_detail {

/// Of a model whose mesh may change, each region's range of levels must be the profile's and hold the
/// level that all leaves start at.
inline Status check_levels(const StretchRules& rules, uint32_t level, uint32_t deepest) {
  if (level > deepest) return Status::kLevelTooDeep;
  if (rules.criterion == StretchCriterion::kFixed) return Status::kDone;
  Status status = Status::kDone;
  for (const uint32_t i : bounded<kRegions>(kRegions, [] {})) {
    const LevelRange& range = rules.levels[i];
    if (level < range.least || level > range.most) status = Status::kLevelsContradictory;
    if (range.most > deepest) return Status::kLevelTooDeep;
  }
  return status;
}

}  // namespace start_detail

template <class Profile>
Status start(State<Profile>& state, const Model& model) {
  state.model = model;
  state.grasp = Grasp::open();
  state.driven = DrivenNode{kNone, zero_vector<Position>()};
  state.contact.clear();
  state.reaction = Reaction::none();
  state.clamps = ClampCounters{0, 0, 0};
  state.tick = 0;
  if (model.dynamics.substeps > Profile::kSubsteps) return Status::kTooManySubsteps;
  const RotationRules& rotation = model.remesh.rotation;
  const bool is_study =
      has_conforming_front(rotation.criterion) || looks_at_neighbours(model.remesh.stretch.criterion);
  if (is_study && !Profile::kStudyCriteria) return Status::kNoSuchCriterion;
  const Status levels = start_detail::check_levels(model.remesh.stretch, model.level, Profile::kMaxLevel);
  if (levels != Status::kDone) return levels;
  MeshStatus mesh = make_roots(state.forest, model.block, model.region_density);
  if (mesh == MeshStatus::kDone) mesh = refine_uniformly(state.forest, model.level);
  if (mesh == MeshStatus::kNodesFull) return Status::kTooManyNodes;
  if (mesh != MeshStatus::kDone) return Status::kTooManyLeaves;
  const uint8_t level = rotation.criterion == RotationCriterion::kFull ? kDeepestLevel : rotation.start_level;
  if (!make_groups(state.forest, state.front, level)) return Status::kTooManyGroups;
  start_groups(state.front, state.groups);
  state.misfits.clear();
  state.urgencies.clear();
  state.tethers.clear();
  state.remesh = RemeshCounters{};
  state.waiting = TurnFlags{};
  start_solve(state.forest, model.dynamics, model.held, state.solve);
  return Status::kDone;
}

}  // namespace palpate
