// The core's mesh and boundary conditions as the reference takes them.
#pragma once

#include <cmath>

#include "palpate/solve/integrate.hpp"
#include "reference/body.hpp"

namespace palpate::reference {

inline Vector in_metres(const Vector3<Position>& x, double edge_m) {
  const double scale = std::ldexp(edge_m, -Position::kFractionBits);
  return Vector(x[0].raw() * scale, x[1].raw() * scale, x[2].raw() * scale);
}

/// Leaves in their order; node i is the forest's i-th live node.
template <class Profile>
Mesh mesh_of(const Forest<Profile>& forest, double edge_m) {
  Mesh mesh;
  std::vector<uint32_t> place(Profile::kNodes, 0);
  for (uint32_t i = 0; i < forest.nodes.used(); ++i) {
    place[forest.nodes.live(i)] = i;
    mesh.rest.push_back(in_metres(rest_position(forest.node.rest[forest.nodes.live(i)]), edge_m));
  }
  for (uint32_t i = 0; i < forest.leaf_count; ++i) {
    const Leaf& leaf = forest.leaf[i];
    mesh.tet.push_back({place[leaf.node[0]], place[leaf.node[1]], place[leaf.node[2]], place[leaf.node[3]]});
    mesh.region.push_back(leaf.region());
  }
  return mesh;
}

template <class Profile>
Positions positions_of(const Forest<Profile>& forest, double edge_m) {
  Positions x;
  for (uint32_t i = 0; i < forest.nodes.used(); ++i) {
    x.push_back(in_metres(forest.node.position[forest.nodes.live(i)], edge_m));
  }
  return x;
}

/// For each node who moves it: 0 nobody, 1 or 2 the first or second held region.
template <class Profile>
std::vector<uint8_t> held_nodes(const Forest<Profile>& forest, const HeldRegions& held) {
  std::vector<uint8_t> control;
  for (uint32_t i = 0; i < forest.nodes.used(); ++i) {
    control.push_back(static_cast<uint8_t>(control_of(forest.node.rest[forest.nodes.live(i)], held)));
  }
  return control;
}

inline RigidMotion rigid_motion(const palpate::RigidMotion& motion, double edge_m) {
  RigidMotion out;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      out.rotation(row, column) =
          std::ldexp(motion.rotation(row, column).raw(), -RotationEntry::kFractionBits);
    }
  }
  out.translation = in_metres(motion.translation, edge_m);
  return out;
}

}  // namespace palpate::reference
