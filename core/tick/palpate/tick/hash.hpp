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
    hash.add(leaf.axes().code() | uint32_t{leaf.level()} << 16 | uint32_t{leaf.region()} << 24);
  }
}

/// The rotation front, what its groups wait for, and the tethers.
template <class Profile>
void add_front(const State<Profile>& state, StateHash& hash) {
  const RotationFront<Profile>& front = state.front;
  hash.add(front.groups.used() | uint32_t{front.pairs_at} << 16);
  for (const uint32_t i : bounded<Profile::kGroups>(front.groups.used(), [] {})) {
    const uint16_t group = front.groups.live(i);
    hash.add(front.tet[group] | uint32_t{front.partner[group]} << 16);
    hash.add(uint32_t{state.groups.blend[group]});
  }
  hash.add(uint32_t{state.tethers.count});
  for (const uint32_t i : bounded<Profile::kTethers>(state.tethers.count, [] {})) {
    const Tether& tether = state.tethers.tether[i];
    hash.add(tether.node | uint32_t{tether.ticks_left} << 16 | static_cast<uint32_t>(tether.kind) << 24);
    hash.add(tether.end[0] | uint32_t{tether.end[1]} << 16);
    hash.add(uint32_t{tether.tet});
  }
}

/// Which leaves want to be split, which of them are next, and where the looks at them go on.
template <class Profile>
void add_urgencies(const State<Profile>& state, StateHash& hash) {
  const Urgencies<Profile>& urgencies = state.urgencies;
  for (const uint32_t i : bounded<Profile::kLeaves>(state.forest.leaf_count, [] {})) {
    hash.add(uint32_t{urgencies.of[i]});
  }
  hash.add(urgencies.sweep_at | uint32_t{urgencies.split_at} << 16);
  hash.add(uint32_t{urgencies.merge_at});
  for (const uint32_t i : bounded<MostUrgent<Profile>::kLooks>(urgencies.chosen.count(), [] {})) {
    hash.add(uint32_t{urgencies.chosen.leaf(i)});
  }
}

/// What the last force evaluation saw of the groups.
template <class Profile>
void add_observations(const State<Profile>& state, StateHash& hash) {
  for (const uint32_t i : bounded<Profile::kGroups>(state.front.groups.used(), [] {})) {
    const uint16_t group = state.front.groups.live(i);
    hash.add(state.groups.gradient[group]);
  }
}

inline void add_rotation(const Quaternion& q, StateHash& hash) {
  hash.add(q.w);
  hash.add(q.x);
  hash.add(q.y);
  hash.add(q.z);
}

/// What the next tick's contact starts from.
inline void add_contact(const Contact& contact, StateHash& hash) {
  hash.add(contact.proxy);
  hash.add(contact.stretch);
  hash.add(contact.anchor);
  hash.add(contact.normal);
  hash.add(contact.force);
  hash.add(contact.load.count | (contact.is_touching ? 1u << 8 : 0u) | (contact.is_certain ? 1u << 9 : 0u) |
           (contact.is_present ? 1u << 10 : 0u));
  for (const uint32_t i : bounded<Load::kMost>(contact.load.count, [] {})) {
    hash.add(uint32_t{contact.load.node[i]});
    hash.add(contact.load.weight[i]);
  }
}

}  // namespace hash_detail

template <class Profile>
void add_stage(const State<Profile>& state, const TickOutput& output, CoreStage stage, StateHash& hash) {
  switch (stage) {
    case CoreStage::kTouch:
      hash.add(uint32_t{state.grasp.node});
      hash.add(state.grasp.offset);
      hash.add(state.driven.target);
      // A body without contact has the hashes that it had before there was any.
      if (state.model.contact.is_on()) hash_detail::add_contact(state.contact, hash);
      break;
    case CoreStage::kRemesh:
      hash_detail::add_mesh(state.forest, hash);
      hash_detail::add_front(state, hash);
      hash_detail::add_urgencies(state, hash);
      hash.add(state.waiting.all());
      break;
    case CoreStage::kRotations:
      for (const uint32_t i : bounded<Profile::kGroups>(state.front.groups.used(), [] {})) {
        const uint16_t group = state.front.groups.live(i);
        hash_detail::add_rotation(state.groups.extracted[group], hash);
        hash_detail::add_rotation(state.groups.used[group], hash);
        hash.add(state.groups.misfit[group]);
        hash.add(state.groups.misfit_left[group]);
      }
      hash.add(uint32_t{state.misfits.group_at} | uint32_t{state.misfits.leaf_at} << 16);
      break;
    case CoreStage::kForces:
      hash_detail::add_nodes(state.forest, state.forest.node.force, hash);
      hash_detail::add_observations(state, hash);
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
      if (state.model.contact.is_on()) {
        hash.add(state.reaction.force);
        hash.add(static_cast<uint64_t>(state.reaction.passivity.energy.raw()));
        hash.add(uint64_t{state.reaction.free_ticks});
      }
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
