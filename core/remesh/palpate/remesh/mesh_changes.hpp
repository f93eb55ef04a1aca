// A turn of the simulation front. Every leaf has an urgency, renewed in slices: how much it wants to be
// split. The most urgent leaves are split, calm patches are merged; tethers keep both from being felt.
#pragma once

#include "palpate/remesh/patch_merges.hpp"
#include "palpate/remesh/patch_splits.hpp"

namespace palpate {

/// A tick of the tethers is in it.
template <class Profile, class Body>
void make_mesh_changes(MeshTurn<Profile, Body>& turn) {
  if (turn.rules.criterion == StretchCriterion::kFixed) return;
  PatchMerges<Profile, Body> merges(turn);
  PatchSplits<Profile, Body> splits(turn);
  merges.end_tethers();
  splits.split_most_urgent();
  merges.draw_calm();
}

}  // namespace palpate
