// Hashes of what each stage wrote, and of all of it. Equal hashes on two machines mean equal bits; the first
// stage in order whose hash differs is where two runs part. Outside the cycle, with the tick held off.
#pragma once

#include "palpate/mesh/state_hash.hpp"
#include "palpate/tick/stage.hpp"
#include "palpate/tick/state.hpp"

namespace palpate {
namespace hash_detail {

template <class Profile, class Scalar>
void add_nodes(const Forest<Profile>& forest, const std::array<Vector3<Scalar>, Profile::kNodes>& values,
               StateHash& hash) {
  for (const uint32_t i : bounded<Profile::kNodes>(forest.nodes.used(), [] {}))
    hash.add(values[forest.nodes.live(i)]);
}

/// The mesh: changes only where it is refined or coarsened.
template <class Profile>
void add_mesh(const Forest<Profile>& forest, StateHash& hash) {
  hash.add(uint32_t{forest.leaf_count});
  hash.add(uint32_t{forest.nodes.used()});
  for (const uint32_t i : bounded<Profile::kLeaves>(forest.leaf_count, [] {})) {
    const Leaf& leaf = forest.leaf[i];
    for (const uint32_t j : bounded<4>(4, [] {})) hash.add(leaf.node[j] | uint32_t{leaf.neighbour[j]} << 16);
    hash.add(leaf.tet | uint32_t{leaf.group} << 16);
    hash.add(leaf.axes.code() | uint32_t{leaf.level} << 16 | uint32_t{leaf.region} << 24);
  }
}

}  // namespace hash_detail

template <class Profile>
void add_stage(const State<Profile>& state, const TickOutput& output, CoreStage stage, StateHash& hash) {
  switch (stage) {
    case CoreStage::kTouch:
      hash.add(uint32_t{state.grasp.node.index} | uint32_t{state.grasp.node.generation} << 16);
      hash.add(state.grasp.offset);
      hash.add(state.driven.target);
      break;
    case CoreStage::kRotations:
      hash_detail::add_mesh(state.forest, hash);
      for (const uint32_t i : bounded<Profile::kGroups>(state.groups.count, [] {})) {
        const Quaternion& q = state.groups.rotation[i];
        hash.add(q.w);
        hash.add(q.x);
        hash.add(q.y);
        hash.add(q.z);
      }
      break;
    case CoreStage::kForces:
      hash_detail::add_nodes(state.forest, state.forest.node.force, hash);
      hash.add(state.clamps.strain);
      break;
    case CoreStage::kIntegrate:
      hash_detail::add_nodes(state.forest, state.forest.node.position, hash);
      hash_detail::add_nodes(state.forest, state.forest.node.velocity, hash);
      hash_detail::add_nodes(state.forest, state.solve.force_position, hash);
      hash.add(state.clamps.speed);
      hash.add(state.clamps.position);
      break;
    case CoreStage::kReaction:
      hash.add(output.reaction);
      hash.add(output.flags);
      break;
  }
}

template <class Profile>
[[nodiscard]] uint64_t stage_hash(const State<Profile>& state, const TickOutput& output, CoreStage stage) {
  StateHash hash;
  add_stage(state, output, stage, hash);
  return hash.value();
}

/// All stages together.
template <class Profile>
[[nodiscard]] uint64_t state_hash(const State<Profile>& state, const TickOutput& output) {
  StateHash hash;
  hash.add(state.tick);
  for (const uint32_t stage : bounded<kCoreStages>(kCoreStages, [] {})) {
    add_stage(state, output, static_cast<CoreStage>(stage), hash);
  }
  return hash.value();
}

}  // namespace palpate
