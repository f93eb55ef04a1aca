// The most urgent leaf may have to wait for a tether near it. Meanwhile the budget is for the others.
#include <gtest/gtest.h>

#include "support/remeshing.hpp"
#include "support/soak.hpp"

namespace palpate::test {
namespace {

struct Starved : TestProfile<1152, 512, 9> {
  static constexpr uint16_t kGroups = 48;
  static constexpr uint32_t kPatches = 1;
  static constexpr uint32_t kTetsSplit = 8;
  static constexpr uint32_t kTetsMerged = 8;
  static constexpr uint16_t kTethers = 64;
};

/// Whether any leaf that waits could be split now, by a look at all of them.
template <class Profile>
bool could_split(const State<Profile>& state) {
  const Forest<Profile>& forest = state.forest;
  for (uint32_t i = 0; i < forest.leaf_count; ++i) {
    const uint16_t tet = forest.leaf[i].tet;
    if (state.urgencies.of[i] < Urgencies<Profile>::kWanted) continue;
    Patch patch{};
    if (find_ready_patch(forest, tet, patch) != MeshStatus::kDone) continue;
    bool may = true;
    for (uint32_t k = 0; k < patch.count; ++k) {
      const Leaf& leaf = forest.leaf_of(patch.tet[k]);
      may = may && leaf.level() < state.model.remesh.stretch.levels[leaf.region()].most;
    }
    const Leaf& leaf = forest.leaf_of(patch.tet[0]);
    const EdgeEnds ends = refinement_edge(leaf);
    for (const uint16_t end : ends) may = may && !state.tethers.holds(end);
    if (may) return true;
  }
  return false;
}

/// Counts turns of the mesh that split nothing although they could have.
template <class Profile>
struct IdleTurns {
  const State<Profile>& state;
  uint32_t bisected = state.remesh.bisected;
  uint32_t in_a_row = 0;
  uint32_t most_in_a_row = 0;
  uint32_t all = 0;
  uint32_t waiting = 0;  // turns in which somebody waited

  void see() {
    constexpr uint32_t kFull = static_cast<uint32_t>(RemeshFlag::kLeaves) |
                               static_cast<uint32_t>(RemeshFlag::kNodes) |
                               static_cast<uint32_t>(RemeshFlag::kTethers);
    const bool split = state.remesh.bisected != bisected;
    bisected = state.remesh.bisected;
    waiting += state.remesh.leaves_waiting > 0 ? 1u : 0u;
    const bool idle = !split && (state.waiting.mesh & kFull) == 0 && could_split(state);
    in_a_row = idle ? in_a_row + 1 : 0;
    most_in_a_row = std::max(most_in_a_row, in_a_row);
    all += idle ? 1u : 0u;
  }
  void print(const char* name) const {
    std::printf("%s: somebody waited in %u turns, %u of them idle, at most %u in a row; %u tets bisected\n",
                name, waiting, all, most_in_a_row, state.remesh.bisected);
  }
};

/// The bar is a little too long everywhere, and a grasped node wants the finest level around it, more
/// urgently than all others. Each of its levels has to wait until the tethers of the one before have let go.
TEST(RemeshStarvation, OthersAreSplitWhileTheMostUrgentLeafWaitsForATether) {
  sim::ModelParameters parameters = remeshing_bar();
  parameters.level = 2;
  parameters.regions[0].most_level = 9;
  const auto state = started<Starved>(compile_model(parameters));
  for (uint32_t i = 0; i < state->forest.nodes.used(); ++i) {
    const uint16_t node = state->forest.nodes.live(i);
    Eigen::Vector3d x = doubles(rest_position(state->forest.node.rest[node]));
    x[2] *= 1.06;
    state->forest.node.position[node] = fixed_vector<Position>(x);
  }
  state->driven.node = node_at(state->forest, LatticePoint{16, 16, -48});
  ASSERT_NE(state->driven.node, kNone);
  IdleTurns<Starved> idle{*state};
  for (int i = 0; i < 600; ++i) {
    change_fronts(*state);
    idle.see();
  }
  idle.print("grasped");
  EXPECT_LE(idle.most_in_a_row, 1u);
  EXPECT_GT(state->forest.leaf_count, 1000u);
}

/// Loaded and unloaded again and again. Two regions, the one in the middle with a bar to its levels that
/// closures of the others run into.
template <class Profile>
void load_often(const char* name) {
  sim::ModelParameters parameters = remeshing_bar();
  parameters.held = sim::HeldEnds::kBoth;
  parameters.regions = {{500.0, 0.45, 1000.0, 1, 5}, {500.0, 0.45, 1000.0, 1, 3}};
  parameters.region_of_cube = {0, 1, 0};
  const auto state = started<Profile>(compile_model(parameters));
  IdleTurns<Profile> idle{*state};
  const int ticks = in_soak(20000, 1500);
  for (int i = 0; i < ticks; ++i) {
    const double part = 0.5 - 0.5 * std::cos(i * 2.0 * 3.14159 / 600.0);
    tick_once(*state, pulled(0.3 * part, 0.5 * part, 0.7 * part));
    if (mesh_had_its_turn(*state)) idle.see();
    ASSERT_NO_FATAL_FAILURE(expect_whole(*state));
  }
  idle.print(name);
  EXPECT_LE(idle.most_in_a_row, 1u);
  EXPECT_GT(state->remesh.bisected, 100u);
}

TEST(RemeshStarvation, NoTurnOfASmallBarIsIdle) { load_often<Small>("small"); }
TEST(RemeshStarvation, NoTurnOfThePapersBarIsIdle) { load_often<CuboidPaper>("cuboid-paper"); }
TEST(RemeshStarvation, NoTurnOfADenseBarIsIdle) { load_often<CuboidDense>("cuboid-dense"); }

}  // namespace
}  // namespace palpate::test
