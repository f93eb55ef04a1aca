#include "bent_bar.hpp"

namespace palpate::bench {
namespace {

/// Corotated forces of all leaves and their sums at the nodes: once a substep, the last one observing.
template <Observe Mode>
void forces(benchmark::State& benchmark_state) {
  const auto bar = make_bent_bar(1);
  GroupForces<Profile> all(bar->forest, bar->front, bar->groups, bar->model.materials, bar->frame);
  const NsPerTet report(benchmark_state, bar->forest.leaf_count);
  for ([[maybe_unused]] auto _ : benchmark_state) {
    benchmark::DoNotOptimize(all.evaluate<Mode>(bar->solve.force_position));
    benchmark::ClobberMemory();
  }
}
BENCHMARK_TEMPLATE(forces, Observe::kNo)->Unit(benchmark::kMicrosecond);
BENCHMARK_TEMPLATE(forces, Observe::kYes)->Unit(benchmark::kMicrosecond);

/// One extraction and one blending step a group: once a tick.
void rotations(benchmark::State& benchmark_state) {
  const auto bar = make_bent_bar(1);
  const NsPerTet report(benchmark_state, bar->front.groups.used());
  for ([[maybe_unused]] auto _ : benchmark_state) {
    update_rotations(bar->front, bar->groups);
    benchmark::ClobberMemory();
  }
}
BENCHMARK(rotations)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace palpate::bench
