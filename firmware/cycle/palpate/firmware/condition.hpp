// What a run can say of its own condition, outside the cycle with the tick held off: how full the pools have
// been, and whether all that must always hold does.
#pragma once

#include "palpate/firmware/cycle.hpp"
#include "palpate/mesh/front_invariants.hpp"
#include "palpate/mesh/invariants.hpp"

namespace palpate::firmware {

enum class Pool : uint8_t { kLeaves, kTetPairs, kNodes, kGroups, kTethers };
inline constexpr uint32_t kPoolCount = 5;

constexpr const char* pool_name(Pool pool) {
  switch (pool) {
    case Pool::kLeaves:
      return "leaves";
    case Pool::kTetPairs:
      return "tet_pairs";
    case Pool::kNodes:
      return "nodes";
    case Pool::kGroups:
      return "groups";
    default:
      return "tethers";
  }
}

struct PoolUse {
  uint32_t peak;
  uint32_t capacity;
  // Since start: times that the pool had no room. Tethers are not asked for one by one, so theirs are the
  // ticks in which a change of the mesh waited for one.
  uint32_t refused;
};

template <class Profile>
[[nodiscard]] PoolUse pool_use(const CycleState<Profile>& state, Pool pool) {
  const auto use = [](PoolCounters counters, uint32_t capacity) {
    return PoolUse{counters.peak, capacity, counters.refused};
  };
  const Forest<Profile>& forest = state.core.forest;
  switch (pool) {
    case Pool::kLeaves:
      return use(forest.leaf_counters, Profile::kLeaves);
    case Pool::kTetPairs:
      return use(forest.pairs.counters(), forest.pairs.kCapacity);
    case Pool::kNodes:
      return use(forest.nodes.counters(), Profile::kNodes);
    case Pool::kGroups:
      return use(state.core.front.groups.counters(), Profile::kGroups);
    default:
      return PoolUse{state.core.tethers.peak, Profile::kTethers, state.tethers_full_ticks};
  }
}

struct Integrity {
  Violation mesh;
  FrontViolation front;
  bool tethers_hold;  // on live nodes, and none on another's ends

  [[nodiscard]] bool is_whole() const {
    return mesh == Violation::kNothing && front == FrontViolation::kNothing && tethers_hold;
  }
};

template <class Profile>
[[nodiscard]] bool tethers_hold(const State<Profile>& state) {
  bool hold = state.tethers.count <= Profile::kTethers;
  for (const uint32_t i : bounded<Profile::kTethers>(state.tethers.count, [] {})) {
    const Tether& tether = state.tethers.tether[i];
    hold = hold && state.forest.nodes.is_live(tether.node) && state.tethers.holds(tether.node);
    for (const uint32_t j : bounded<2>(2, [] {})) {
      hold = hold && state.forest.nodes.is_live(tether.end[j]) && !state.tethers.holds(tether.end[j]);
    }
  }
  return hold;
}

/// O(groups x nodes + leaves x levels). Some 2 KiB of stack.
template <class Profile>
[[nodiscard]] Integrity check_integrity(const CycleState<Profile>& state) {
  return {check_forest(state.core.forest, state.core.model.block),
          check_front(state.core.forest, state.core.front), tethers_hold(state.core)};
}

}  // namespace palpate::firmware
