// Whether the mesh is still what it must be, a leaf a tick.
#pragma once

#include "palpate/mesh/invariants.hpp"

namespace palpate::firmware {

struct InvariantWatch {
  uint32_t next_leaf;
  bool is_broken;  // for good
};

/// All leaves in leaf_count ticks; one that a change of the mesh takes to where the walk has
/// been comes in the next round. Constant time.
template <class Profile>
void examine_leaf(const Forest<Profile>& forest, const Block& block, InvariantWatch& watch) {
  if (watch.next_leaf >= forest.leaf_count) watch.next_leaf = 0;
  if (check_leaf(forest, block, watch.next_leaf) != Violation::kNothing) watch.is_broken = true;
  ++watch.next_leaf;
}

}  // namespace palpate::firmware
