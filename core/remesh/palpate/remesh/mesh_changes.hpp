// A turn of the simulation front, and what is done before and after it, in ticks that have time. Every leaf
// has an urgency, renewed in slices: how much it wants to be split. The most urgent leaves are split, calm
// patches are merged; tethers keep both from being felt.
#pragma once

#include "palpate/remesh/patch_merges.hpp"
#include "palpate/remesh/patch_splits.hpp"

namespace palpate {

/// Before the turn: which leaves it is to split.
template <class Profile, class Body>
void choose_splits(MeshTurn<Profile, Body>& turn) {
  if (turn.rules.criterion == StretchCriterion::kFixed) return;
  PatchSplits<Profile, Body>(turn).choose_most_urgent();
}

/// A tick of the tethers is in it.
template <class Profile, class Body>
void make_mesh_changes(MeshTurn<Profile, Body>& turn) {
  if (turn.rules.criterion == StretchCriterion::kFixed) return;
  PatchMerges<Profile, Body> merges(turn);
  PatchSplits<Profile, Body> splits(turn);
  merges.end_tethers();
  splits.split_chosen();
}

/// After the turn: what a later one is to merge.
template <class Profile, class Body>
void begin_merges(MeshTurn<Profile, Body>& turn) {
  if (turn.rules.criterion == StretchCriterion::kFixed) return;
  PatchMerges<Profile, Body>(turn).draw_calm();
}

}  // namespace palpate
