// The re-mesh stage: remesh decides, and here is what its decisions mean to elasticity and to the solver.
#pragma once

#include "palpate/remesh/mesh_changes.hpp"
#include "palpate/remesh/rotation_changes.hpp"
#include "palpate/tick/state.hpp"

namespace palpate {

/// Elasticity as RotationChanges sees it.
template <class Profile>
struct GroupRotations {
  Groups<Profile>& groups;
  const RotationFront<Profile>& front;
  const Forest<Profile>& forest;
  RotationCriterion criterion;

  [[nodiscard]] uint32_t split_measure(uint16_t group) const {
    if (criterion != RotationCriterion::kSiblings) return static_cast<uint32_t>(groups.misfit[group].raw());
    const uint16_t sibling = Forest<Profile>::sibling(front.tet[group]);
    const uint16_t other = forest.leaf_of(first_leaf(forest, sibling)).group;
    return front.tet[other] == sibling ? static_cast<uint32_t>(difference(group, other).raw()) : 0;
  }
  [[nodiscard]] uint32_t join_measure(uint16_t group, uint16_t partner) const {
    const Q<4, 27> square = difference(group, partner);
    if (criterion == RotationCriterion::kSiblings) return static_cast<uint32_t>(square.raw());
    const uint32_t parent_level = forest.tet[front.tet[group]].level - 1u;
    return static_cast<uint32_t>(
        joined_misfit(square, groups.misfit_left[group], groups.misfit_left[partner], parent_level).raw());
  }
  [[nodiscard]] bool is_blending(uint16_t group) const { return groups.blend[group] > 0; }
  [[nodiscard]] bool changed_now(uint16_t group) const { return groups.blend[group] == kBlendTicks; }
  void blend(uint16_t group) { groups.blend[group] = kBlendTicks; }
  void inherit(uint16_t group, uint16_t added) { inherit_rotation(groups, group, added); }
  void take_over(uint16_t group, uint16_t gone) { take_over_rotation(groups, group, gone); }

 private:
  [[nodiscard]] Q<4, 27> difference(uint16_t a, uint16_t b) const {
    return square_of_difference(groups.extracted[a], groups.extracted[b]);
  }
};

/// The solver as MeshChanges sees it.
template <class Profile>
struct SolvedNodes {
  Forest<Profile>& forest;
  SolveState<Profile>& solve;
  const Model& model;

  [[nodiscard]] bool is_free(uint16_t node) const { return solve.control[node] == NodeControl::kFree; }
  void added(uint16_t node, const std::array<uint16_t, 2>& ends) {
    start_node(forest, model.dynamics, model.held, node, solve);
    removed(ends);
  }
  void before_removal(uint16_t node, const std::array<uint16_t, 2>& ends) {
    absorb_momentum(forest, solve, node, ends);
  }
  void removed(const std::array<uint16_t, 2>& ends) {
    for (const uint32_t i : bounded<2>(2, [] {})) {
      solve.impulse[ends[i]] = impulse_of(model.dynamics, forest.node.mass[ends[i]]);
    }
  }
};

/// Changes of both fronts for one tick. The rotation front comes first: its lists are of the mesh as it is.
template <class Profile>
void change_fronts(State<Profile>& state) {
  bool changed = false;
  const RemeshRules& rules = state.model.remesh;
  GroupRotations<Profile> rotations{state.groups, state.front, state.forest, rules.rotation.criterion};
  RotationChanges<Profile, GroupRotations<Profile>> rotation_changes(state.forest, state.front, rules.rotation,
                                                                     rotations, state.remesh);
  state.waiting = rotation_changes.run(changed);
  SolvedNodes<Profile> nodes{state.forest, state.solve, state.model};
  MeshChanges<Profile, SolvedNodes<Profile>> mesh_changes(state.forest, state.front, state.tethers,
                                                          state.urgencies, rules.stretch, state.driven.node,
                                                          nodes, state.remesh);
  state.waiting |= mesh_changes.run(changed);
  if (changed) index_groups(state.forest, state.front);
}

}  // namespace palpate
