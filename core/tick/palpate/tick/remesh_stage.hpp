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
  const RotationRules& rules;

  [[nodiscard]] uint32_t split_measure(uint16_t group) const {
    if (!by_siblings()) return static_cast<uint32_t>(groups.misfit[group].raw());
    const uint16_t sibling = Forest<Profile>::sibling(front.tet[group]);
    const uint16_t other = group_in(sibling);
    return front.tet[other] == sibling ? difference(group, other) : 0;
  }
  [[nodiscard]] uint32_t join_measure(uint16_t group, uint16_t partner) const {
    const uint16_t parent = forest.parent_of(front.tet[group]);
    const uint32_t apart = difference(group, partner);
    if (by_siblings()) {
      // A parent that would differ from its own sibling would be split again at once, for ever.
      const uint32_t parents_apart = difference(group, group_in(Forest<Profile>::sibling(parent)));
      return parents_apart > rules.split_above ? parents_apart : apart;
    }
    return static_cast<uint32_t>(joined_misfit(Q<4, 27>::from_raw(static_cast<int32_t>(apart)),
                                               groups.misfit_left[group], groups.misfit_left[partner],
                                               forest.tet[parent].level)
                                     .raw());
  }
  [[nodiscard]] bool is_blending(uint16_t group) const { return groups.blend[group] > 0; }
  [[nodiscard]] bool changed_now(uint16_t group) const { return groups.blend[group] == kBlendTicks; }
  void blend(uint16_t group) { groups.blend[group] = kBlendTicks; }
  void inherit(uint16_t group, uint16_t added) { inherit_rotation(groups, group, added); }
  void take_over(uint16_t group, uint16_t gone) { take_over_rotation(groups, group, gone); }

 private:
  [[nodiscard]] bool by_siblings() const { return rules.criterion == RotationCriterion::kSiblings; }
  /// A group of a tet: the tet's own, one above it, or one of those below.
  [[nodiscard]] uint16_t group_in(uint16_t tet) const {
    return forest.leaf_of(first_leaf(forest, tet)).group;
  }
  [[nodiscard]] uint32_t difference(uint16_t a, uint16_t b) const {
    return static_cast<uint32_t>(square_of_difference(groups.extracted[a], groups.extracted[b]).raw());
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
  GroupRotations<Profile> rotations{state.groups, state.front, state.forest, rules.rotation};
  RotationChanges<Profile, GroupRotations<Profile>> rotation_changes(state.forest, state.front,
                                                                     rules.rotation, rotations, state.remesh);
  state.waiting = rotation_changes.run(changed);
  SolvedNodes<Profile> nodes{state.forest, state.solve, state.model};
  MeshChanges<Profile, SolvedNodes<Profile>> mesh_changes(state.forest, state.front, state.tethers,
                                                          state.urgencies, rules.stretch, state.driven.node,
                                                          nodes, state.remesh);
  state.waiting |= mesh_changes.run(changed);
  if (changed) index_groups(state.forest, state.front);
}

}  // namespace palpate
