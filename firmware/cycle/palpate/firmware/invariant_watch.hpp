// Whether the mesh is still what it must be, a few leaves a tick.
#pragma once

#include "palpate/mesh/invariants.hpp"

namespace palpate::firmware {

struct InvariantWatch {
  static constexpr uint32_t kLeavesATick = 4;
  uint32_t next_leaf;
  bool is_broken;  // for good
};

/// All leaves in leaf_count / kLeavesATick ticks; one that a change of the mesh takes to where the walk has
/// been comes in the next round. Constant time.
template <class Profile>
void examine_slice(const Forest<Profile>& forest, const Block& block, InvariantWatch& watch) {
  for ([[maybe_unused]] const uint32_t i :
       bounded<InvariantWatch::kLeavesATick>(InvariantWatch::kLeavesATick, [] {})) {
    if (watch.next_leaf >= forest.leaf_count) watch.next_leaf = 0;
    if (check_leaf(forest, block, watch.next_leaf) != Violation::kNothing) watch.is_broken = true;
    ++watch.next_leaf;
  }
}

}  // namespace palpate::firmware
