// Where a contact force acts on the body: up to kMost nodes with weights that are together exactly 1. Forces
// on them add up to the opposite of the force on the tool, to the last bit, so linear momentum is exact.
#pragma once

#include "palpate/mesh/forest.hpp"
#include "palpate/touch/surface.hpp"

namespace palpate {

struct Load {
  static constexpr uint32_t kMost = 6;
  uint32_t count;
  std::array<uint16_t, kMost> node;
  std::array<Fraction, kMost> weight;

  void put_on(const SurfacePoint& point) {
    count = 3;
    for (const uint32_t i : bounded<3>(3, [] {})) {
      node[i] = point.node[i];
      weight[i] = point.weight[i];
    }
  }
};

/// A node is about to be merged away: its weight goes to the ends of its edge, in halves. When there is no
/// room for another node, all of it goes to the first.
inline void move_load(Load& load, uint16_t node, const std::array<uint16_t, 2>& ends) {
  for (const uint32_t i : bounded<Load::kMost>(load.count, [] {})) {
    if (load.node[i] != node) continue;
    load.node[i] = ends[0];
    if (load.count == Load::kMost) continue;
    const auto half = Fraction::from_raw(load.weight[i].raw() / 2);
    load.weight[i] -= half;
    load.node[load.count] = ends[1];
    load.weight[load.count] = half;
    ++load.count;
  }
}

/// Sum of the nodes' positions by weight: the material point under the tool. Nodes must be live.
template <class Profile>
[[nodiscard]] Vector3<Position> loaded_point(const Forest<Profile>& forest, const Load& load) {
  constexpr int kBits = Position::kFractionBits + Fraction::kFractionBits;
  std::array<Acc<kBits>, 3> sum{};
  for (const uint32_t i : bounded<Load::kMost>(load.count, [] {})) {
    const Vector3<Position>& x = forest.node.position[load.node[i]];
    for (const uint32_t axis : bounded<3>(3, [] {})) {
      sum[axis] += x[static_cast<Eigen::Index>(axis)] * load.weight[i];
    }
  }
  return Vector3<Position>(narrow<Position>(sum[0]), narrow<Position>(sum[1]), narrow<Position>(sum[2]));
}

/// Adds - force to the nodes' forces: shares by weight, the last one what is left of it.
template <class Profile>
void add_load(Forest<Profile>& forest, const Load& load, const Vector3<Force>& force) {
  Vector3<Force> left = force;
  for (const uint32_t i : bounded<Load::kMost>(load.count, [] {})) {
    const bool is_last = i + 1 == load.count;
    const Vector3<Force> share = is_last ? left : part_of(force, load.weight[i]);
    forest.node.force[load.node[i]] -= share;
    left -= share;
  }
}

}  // namespace palpate
