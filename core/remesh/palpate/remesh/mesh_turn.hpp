// What the changes of a turn of the simulation front have in common: what they work on, and what came of it.
// mesh_changes.hpp has the turns.
//
// `Body` is what the solver knows and does; a struct with
//   bool is_free(node)                                       nothing else moves it
//   void added(node, ends)                                   after a split
//   void before_removal(node, ends), void removed(ends)      around a merge
#pragma once

#include "palpate/mesh/patch.hpp"
#include "palpate/mesh/rotation_front.hpp"
#include "palpate/mesh/tether.hpp"
#include "palpate/remesh/turn_outcome.hpp"
#include "palpate/remesh/urgency.hpp"

namespace palpate {

template <class Profile, class Body>
struct MeshTurn : TurnOutcome {
  MeshTurn(Forest<Profile>& the_forest, RotationFront<Profile>& the_front, Tethers<Profile>& the_tethers,
           Urgencies<Profile>& the_urgencies, const StretchRules& the_rules, uint16_t the_pinned,
           Body& the_body, RemeshCounters& the_counters)
      : forest(the_forest),
        front(the_front),
        tethers(the_tethers),
        urgencies(the_urgencies),
        rules(the_rules),
        pinned(the_pinned),
        body(the_body),
        counters(the_counters) {}

  /// No edge is split at a slaved node. 0 or 1, without a branch.
  [[nodiscard]] uint32_t tethered(const EdgeEnds& ends) const {
    return static_cast<uint32_t>(tethers.holds_node[ends[0]]) | tethers.holds_node[ends[1]];
  }
  [[nodiscard]] bool is_tethered(const EdgeEnds& ends) const { return tethered(ends) != 0; }
  void tether(uint16_t middle, const EdgeEnds& ends, uint16_t tet, TetherKind kind) {
    tethers.add(Tether{middle, {ends[0], ends[1]}, tet, kTetherTicks, kind, 0});
  }

  [[nodiscard]] uint16_t place_of(uint16_t leaf_tet) const { return forest.tet[leaf_tet].link(); }

  Forest<Profile>& forest;
  RotationFront<Profile>& front;
  Tethers<Profile>& tethers;
  Urgencies<Profile>& urgencies;
  const StretchRules& rules;
  uint16_t pinned;  // a node whose leaves go to their finest level and are never merged, or kNone
  Body& body;
  RemeshCounters& counters;
};

}  // namespace palpate
