// What can be read off a body in any profile, in millimetres and newtons.
#pragma once

#include <fmt/format.h>

#include "palpate/tick/tick.hpp"
#include "simulation/simulation.hpp"
#include "units.hpp"

namespace palpate::sim {

/// For node_mm of a scenario.
inline constexpr double kNodeToleranceMm = 10.0;

template <class Profile>
void require_started(Status status) {
  if (status == Status::kDone) return;
  throw BadInput(fmt::format("the model does not fit profile {}: take a lower level or a larger profile",
                             Profile::kName));
}

template <class Profile>
Totals read_totals(const State<Profile>& state) {
  const auto& forest = state.forest;
  const auto& groups = state.front.groups;
  return Totals{{forest.leaf_count, forest.leaf_counters.peak},
                {forest.nodes.used(), forest.nodes.counters().peak},
                {groups.used(), groups.counters().peak},
                {state.tethers.count, state.tethers.peak},
                state.remesh,
                state.clamps};
}

/// The node nearest to the scenario's at rest; BadInput when that is too far away.
template <class Profile>
uint16_t find_node(const State<Profile>& state, const Scenario& scenario, double farthest_mm) {
  const auto& mm = scenario.node_mm;
  const auto reach = to_fixed<Position>(std::min(farthest_mm * 1e-3 / scenario.model.edge_m, 4.0));
  const uint16_t node = nearest_node(state.forest, from_mm(mm, scenario.model), reach);
  if (node != kNone) return node;
  const auto& cubes = scenario.model.cubes;
  const double edge_mm = scenario.model.edge_m * 1e3;
  throw BadInput(fmt::format(
      "no node is within {:g} mm of ({:g}, {:g}, {:g}) mm; the block fills (0, 0, 0) to ({:g}, "
      "{:g}, {:g}) mm",
      farthest_mm, mm[0], mm[1], mm[2], cubes[0] * edge_mm, cubes[1] * edge_mm, cubes[2] * edge_mm));
}

template <class Profile>
std::array<double, 3> displacement_mm(const State<Profile>& state, uint16_t node, double edge_m) {
  const auto now = to_doubles(state.forest.node.position[node]);
  const auto rest = to_doubles(rest_position(state.forest.node.rest[node]));
  std::array<double, 3> mm{};
  for (std::size_t axis = 0; axis < 3; ++axis) mm[axis] = (now[axis] - rest[axis]) * edge_m * 1e3;
  return mm;
}

/// Nodes so ordered that the triangle's normal points away from `inside`.
inline std::array<uint32_t, 3> facing_away(const std::array<uint32_t, 3>& triangle, uint32_t inside,
                                           const std::vector<std::array<double, 3>>& at) {
  const auto edge = [&](uint32_t to) {
    const auto& p = at[triangle[0]];
    return std::array<double, 3>{at[to][0] - p[0], at[to][1] - p[1], at[to][2] - p[2]};
  };
  const auto a = edge(triangle[1]);
  const auto b = edge(triangle[2]);
  const auto c = edge(inside);
  const double volume = c[0] * (a[1] * b[2] - a[2] * b[1]) + c[1] * (a[2] * b[0] - a[0] * b[2]) +
                        c[2] * (a[0] * b[1] - a[1] * b[0]);
  return volume < 0.0 ? triangle : std::array<uint32_t, 3>{triangle[0], triangle[2], triangle[1]};
}

template <class Profile>
BodyShape read_shape(const State<Profile>& state, const ModelParameters& model) {
  const auto& forest = state.forest;
  BodyShape shape;
  std::array<uint32_t, Profile::kNodes> place{};
  for (uint32_t i = 0; i < forest.nodes.used(); ++i) {
    const uint16_t node = forest.nodes.live(i);
    place[node] = i;
    shape.rest_mm.push_back(to_mm(rest_position(forest.node.rest[node]), model));
    shape.now_mm.push_back(to_mm(forest.node.position[node], model));
  }
  for (uint32_t i = 0; i < forest.leaf_count; ++i) {
    const Leaf& leaf = forest.leaf[i];
    for (std::size_t face = 0; face < 4; ++face) {
      if (leaf.neighbour[face] != kNone) continue;
      const auto at = [&](std::size_t k) { return place[leaf.node[(face + k) % 4]]; };
      shape.triangles.push_back(facing_away({at(1), at(2), at(3)}, at(0), shape.rest_mm));
      shape.rotation_tet.push_back(leaf.group);
    }
  }
  return shape;
}

inline std::array<double, 3> scaled(std::array<double, 3> v, double factor) {
  for (double& component : v) component *= factor;
  return v;
}

}  // namespace palpate::sim
