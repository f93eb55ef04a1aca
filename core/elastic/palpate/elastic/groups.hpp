// Groups: a tet whose rotation is extracted, with the leaves that use it. Here every leaf is its own group
// (full corotation); a leaf only knows its group's index, so a coarser front changes nothing in the force
// loop.
#pragma once

#include "palpate/elastic/element_force.hpp"

namespace palpate {

template <class Profile>
struct Groups {
  static constexpr uint16_t kGroups = Profile::kGroups;

  uint16_t count;
  std::array<uint16_t, kGroups> tet;
  std::array<Quaternion, kGroups> rotation;
  std::array<RotationMatrix, kGroups> matrix;  // of `rotation`, what the force loop reads
};

/// One group a leaf, unrotated. False when there are more leaves than groups.
template <class Profile>
[[nodiscard]] bool group_every_leaf(Forest<Profile>& forest, Groups<Profile>& groups) {
  groups.count = 0;
  if (forest.leaf_count > Profile::kGroups) return false;
  groups.count = forest.leaf_count;
  for (const uint32_t i : bounded<Profile::kGroups>(forest.leaf_count, [] {})) {
    forest.leaf[i].group = static_cast<uint16_t>(i);
    groups.tet[i] = forest.leaf[i].tet;
    groups.rotation[i] = Quaternion::identity();
    groups.matrix[i] = rotation_matrix(Quaternion::identity());
  }
  return true;
}

/// One extraction step a group from the positions as they are. Strain clamps are counted by the force loop.
template <class Profile>
void update_rotations(const Forest<Profile>& forest, Groups<Profile>& groups) {
  const auto& position = forest.node.position;
  for (const uint32_t i : bounded<Profile::kGroups>(groups.count, [] {})) {
    const Leaf& leaf = forest.leaf_of(groups.tet[i]);
    const EdgeVectors edges =
        edge_vectors(type_of_level(leaf.level), position[leaf.node[0]], position[leaf.node[1]],
                     position[leaf.node[2]], position[leaf.node[3]]);
    uint32_t clamped = 0;
    const DeformationGradient f = deformation_gradient(edges, leaf.axes, leaf.level, clamped);
    groups.rotation[i] = extract_rotation(f, groups.rotation[i]);
    groups.matrix[i] = rotation_matrix(groups.rotation[i]);
  }
}

/// Overwrites every node's force with the corotated forces of all leaves at `at` (positions, or positions
/// moved on by stiffness damping). Returns the number of leaves whose strain or stress was clamped. Integer
/// sums: any order of leaves gives the same bits.
template <class Profile>
uint32_t evaluate_forces(Forest<Profile>& forest, const Groups<Profile>& groups, const Materials& materials,
                         const std::array<Vector3<Position>, Profile::kNodes>& at) {
  auto& force = forest.node.force;
  for (const uint32_t i : bounded<Profile::kNodes>(forest.nodes.used(), [] {})) {
    force[forest.nodes.live(i)] = zero_vector<Force>();
  }
  uint32_t clamped_leaves = 0;
  for (const uint32_t i : bounded<Profile::kLeaves>(forest.leaf_count, [] {})) {
    const Leaf& leaf = forest.leaf[i];
    const TetType type = type_of_level(leaf.level);
    const EdgeVectors edges =
        edge_vectors(type, at[leaf.node[0]], at[leaf.node[1]], at[leaf.node[2]], at[leaf.node[3]]);
    uint32_t clamped = 0;
    const EdgeForces t = corotated_edge_forces(edges, leaf.axes, leaf.level, groups.matrix[leaf.group],
                                               materials[leaf.region], clamped);
    add_nodal_forces(type, t, force[leaf.node[0]], force[leaf.node[1]], force[leaf.node[2]],
                     force[leaf.node[3]]);
    clamped_leaves += clamped != 0 ? 1u : 0u;
  }
  return clamped_leaves;
}

}  // namespace palpate
