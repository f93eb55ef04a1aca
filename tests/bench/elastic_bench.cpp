#include "bent_bar.hpp"

namespace palpate::bench {
namespace {

/// Corotated forces of all leaves and their sums at the nodes: once a substep.
void forces(benchmark::State& benchmark_state) {
  const auto bar = make_bent_bar(1);
  const NsPerTet report(benchmark_state, bar->forest.leaf_count);
  for ([[maybe_unused]] auto _ : benchmark_state) {
    benchmark::DoNotOptimize(
        evaluate_forces(bar->forest, bar->groups, bar->model.materials, bar->solve.force_position));
    benchmark::ClobberMemory();
  }
}
BENCHMARK(forces)->Unit(benchmark::kMicrosecond);

/// One extraction step a group, and its matrix: once a tick.
void rotations(benchmark::State& benchmark_state) {
  const auto bar = make_bent_bar(1);
  const NsPerTet report(benchmark_state, bar->groups.count);
  for ([[maybe_unused]] auto _ : benchmark_state) {
    update_rotations(bar->forest, bar->groups);
    benchmark::ClobberMemory();
  }
}
BENCHMARK(rotations)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace palpate::bench
