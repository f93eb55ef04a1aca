// Bodies in motion, for tests of what a change of the mesh does to it.
#pragma once

#include "palpate/tick/remesh_stage.hpp"
#include "support/bodies.hpp"
#include "support/elastic_bodies.hpp"

namespace palpate::test {

using MovingProfile = TestProfile<500, 300, 9>;

/// A body in motion, with what the solver knows of it.
struct Moving {
  ElasticBody<MovingProfile> body;
  Model model;
  std::unique_ptr<SolveState<MovingProfile>> solve = std::make_unique<SolveState<MovingProfile>>();

  [[nodiscard]] SolvedNodes<MovingProfile> nodes() {
    return SolvedNodes<MovingProfile>{body.forest(), *solve, model};
  }
};

inline Dynamics some_dynamics() {
  sim::ModelParameters parameters = coarse_bar(1000.0, 2);
  return compile_model(parameters).dynamics;
}

/// As a substep leaves it.
inline void leave_force_position(Moving& m, uint16_t n) {
  for (int a = 0; a < 3; ++a) {
    m.solve->force_position[n][a] = integrate_detail::force_position(
        m.body.node().position[n][a], m.body.node().velocity[n][a], m.model.dynamics.stiffness_damping);
  }
}

inline Moving moving_body(Random& random, double strength) {
  Moving made{random_body<MovingProfile>(random), Model{}};
  made.model.dynamics = some_dynamics();
  made.model.held = {LatticeBox{{-48, -32, -32}, {48, 32, -32}}, LatticeBox{{1, 1, 1}, {0, 0, 0}}};
  if (strength > 0.0) deform_at_random(made.body, random, strength);
  made.body.for_nodes(
      [&](uint16_t n) { made.body.node().velocity[n] = fixed_vector<Velocity>(1e-3 * random.vector()); });
  start_solve(made.body.forest(), made.model.dynamics, made.model.held, *made.solve);
  made.body.for_nodes([&](uint16_t n) { leave_force_position(made, n); });
  return made;
}

struct Split {
  uint16_t node;
  std::array<uint16_t, 2> ends;
  Patch patch;
};

/// A patch at a random place, in the way PatchSplits does it. Node kNone if the pools are full.
inline Split split_at_random(Moving& m, Random& random) {
  Split split{kNone, {}, {}};
  Forest<MovingProfile>& forest = m.body.forest();
  const uint16_t wanted = forest.leaf[random.below(forest.leaf_count)].tet;
  if (find_ready_patch(forest, wanted, split.patch) != MeshStatus::kDone) return split;
  split.ends = refinement_edge(forest.leaf_of(split.patch.tet[0]));
  if (bisect(forest, split.patch) != MeshStatus::kDone) return split;
  split.node = forest.nodes.live(forest.nodes.used() - 1u);
  m.nodes().added(split.node, split.ends);
  count_and_index_groups(forest, m.body.front());
  return split;
}

/// Whether nothing but forces moves the node.
inline bool is_free(const Moving& m, uint16_t node) { return m.solve->control[node] == NodeControl::kFree; }

}  // namespace palpate::test
