// The re-mesh stage: remesh decides, and here is what its decisions mean to elasticity and to the solver.
#pragma once

#include "palpate/remesh/mesh_changes.hpp"
#include "palpate/remesh/rotation_changes.hpp"
#include "palpate/tick/state.hpp"

namespace palpate {

/// Elasticity as a RotationTurn sees it, and of the mesh what full corotation asks for.
template <class Profile>
struct GroupRotations {
  Groups<Profile>& groups;
  const RotationFront<Profile>& front;
  const Forest<Profile>& forest;
  const Urgencies<Profile>& urgencies;
  const RotationRules& rules;

  [[nodiscard]] uint32_t split_measure(uint16_t group) const {
    if constexpr (Profile::kStudyCriteria) {
      if (rules.criterion == RotationCriterion::kSiblings) return from_sibling(group);
      if (rules.criterion == RotationCriterion::kFull) return may_share(front.tet[group]) ? 0u : 1u;
    }
    return static_cast<uint32_t>(groups.misfit[group].raw());
  }
  /// Siblings: how far the two are apart, or their parent and its sibling, if that is more: it would be split
  /// again at once.
  [[nodiscard]] uint32_t join_measure(uint16_t group, uint16_t partner) const {
    const uint16_t parent = forest.parent_of(front.tet[group]);
    const uint32_t halves_apart = difference(group, partner);
    if constexpr (Profile::kStudyCriteria) {
      if (rules.criterion == RotationCriterion::kFull) return may_share(parent) ? 0u : 1u;
      if (rules.criterion == RotationCriterion::kSiblings) {
        const uint32_t parents_apart = apart(parent, Forest<Profile>::sibling(parent));
        return parents_apart > halves_apart ? parents_apart : halves_apart;
      }
    }
    return static_cast<uint32_t>(joined_misfit(Q<4, 27>::from_raw(static_cast<int32_t>(halves_apart)),
                                               groups.misfit_left[group], groups.misfit_left[partner],
                                               forest.level_of(parent))
                                     .raw());
  }
  [[nodiscard]] bool is_blending(uint16_t group) const { return groups.blend[group] > 0; }
  [[nodiscard]] bool changed_now(uint16_t group) const { return groups.blend[group] == kBlendSteps; }
  void blend(uint16_t group) { groups.blend[group] = kBlendSteps; }
  void inherit(uint16_t group, uint16_t added) { inherit_rotation(groups, group, added); }
  void take_over(uint16_t group, uint16_t gone) { take_over_rotation(groups, group, gone); }

 private:
  /// 0 when the sibling is split.
  [[nodiscard]] uint32_t from_sibling(uint16_t group) const {
    const uint16_t sibling = Forest<Profile>::sibling(front.tet[group]);
    const uint16_t other = group_in(sibling);
    return front.tet[other] == sibling ? difference(group, other) : 0;
  }
  /// Two groups whose mean is the rotation of a tet: its own or one above it, twice, or those of its halves.
  /// `known` is false where the front is deeper.
  struct Halves {
    uint16_t first, second;
    bool known;
  };

  [[nodiscard]] Halves halves_of(uint16_t tet) const {
    const uint16_t group = group_in(tet);
    if (forest.level_of(front.tet[group]) <= forest.level_of(tet)) return {group, group, true};
    if (front.tet[group] != forest.child(tet, 0)) return {group, group, false};
    // Of a pair about to be joined the first holds their parent's rotation already.
    if (front.partner[group] != kNone) return {group, group, true};
    const uint16_t other = group_in(forest.child(tet, 1));
    return {group, other, front.tet[other] == forest.child(tet, 1)};
  }
  /// |R_a - R_b|_F^2, for a tet with two groups of the mean of their matrices; 0 where it is not known.
  [[nodiscard]] uint32_t apart(uint16_t tet_a, uint16_t tet_b) const {
    const Halves a = halves_of(tet_a);
    const Halves b = halves_of(tet_b);
    if (!a.known || !b.known) return 0;
    if (a.first == a.second && b.first == b.second) return difference(a.first, b.first);
    // Of two means, squared: a quarter of the four distances less a quarter of the two within.
    const uint32_t across = difference(a.first, b.first) / 4 + difference(a.first, b.second) / 4 +
                            difference(a.second, b.first) / 4 + difference(a.second, b.second) / 4;
    const uint32_t within = difference(a.first, a.second) / 4 + difference(b.first, b.second) / 4;
    return across > within ? across - within : 0;
  }
  /// Full corotation: whether the halves of a tet are leaves that are about to be merged. Only these share a
  /// rotation, so that the mesh can rise above them.
  [[nodiscard]] bool may_share(uint16_t tet) const {
    bool may = true;
    for (const uint32_t which : bounded<2>(2, [] {})) {
      const uint16_t child = forest.child(tet, which);
      may = may && forest.tet[child].is_leaf() &&
            urgencies.of[forest.tet[child].link()] == Urgencies<Profile>::kCalm;
    }
    return may;
  }
  /// A group of a tet: the tet's own, one above it, or one of those below.
  [[nodiscard]] uint16_t group_in(uint16_t tet) const {
    return forest.leaf_of(first_leaf(forest, tet)).group;
  }
  [[nodiscard]] uint32_t difference(uint16_t a, uint16_t b) const {
    return static_cast<uint32_t>(square_of_difference(groups.extracted[a], groups.extracted[b]).raw());
  }
};

/// The solver as a MeshTurn sees it.
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

/// And the contact of the tool, which must not lose a node that it acts on.
template <class Profile>
struct TouchedNodes : SolvedNodes<Profile> {
  Load& load;

  void before_removal(uint16_t node, const std::array<uint16_t, 2>& ends) {
    move_load(load, node, ends);
    SolvedNodes<Profile>::before_removal(node, ends);
  }
};

/// The turn of the rotation front.
template <class Profile>
void change_front(State<Profile>& state) {
  const RotationRules& rules = state.model.remesh.rotation;
  GroupRotations<Profile> rotations{state.groups, state.front, state.forest, state.urgencies, rules};
  RotationTurn<Profile, GroupRotations<Profile>> turn(state.forest, state.front, rules, rotations,
                                                      state.remesh);
  RotationChanges<Profile, GroupRotations<Profile>>(turn).run();
  state.waiting.front = turn.flags;
  if (turn.changed) index_groups(state.forest, state.front);
}

template <class Profile>
TouchedNodes<Profile> touched_nodes(State<Profile>& state) {
  return {{state.forest, state.solve, state.model}, state.contact.load};
}
template <class Profile>
MeshTurn<Profile, TouchedNodes<Profile>> turn_of_mesh(State<Profile>& state, TouchedNodes<Profile>& nodes) {
  return {state.forest,      state.front, state.tethers, state.urgencies, state.model.remesh.stretch,
          state.driven.node, nodes,       state.remesh};
}

/// The turn of the mesh.
template <class Profile>
void change_mesh(State<Profile>& state) {
  auto nodes = touched_nodes(state);
  auto turn = turn_of_mesh(state, nodes);
  make_mesh_changes(turn);
  state.waiting.mesh = turn.flags;
  if (turn.changed) index_groups(state.forest, state.front);
}

/// What the next turn of the mesh goes by.
template <class Profile>
void judge_mesh(State<Profile>& state) {
  const StretchRules& rules = state.model.remesh.stretch;
  if (rules.criterion != StretchCriterion::kFixed)
    renew_urgencies(state.forest, rules, state.driven.node, state.urgencies);
}

/// In the tick before a turn of the mesh.
template <class Profile>
void choose_for_mesh(State<Profile>& state) {
  auto nodes = touched_nodes(state);
  auto turn = turn_of_mesh(state, nodes);
  choose_splits(turn);
}

/// In the tick after one.
template <class Profile>
void draw_for_mesh(State<Profile>& state) {
  auto nodes = touched_nodes(state);
  auto turn = turn_of_mesh(state, nodes);
  begin_merges(turn);
  state.waiting.draws = turn.flags;
}

}  // namespace palpate
