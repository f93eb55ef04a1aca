#include "bent_bar.hpp"
#include "palpate/tick/hash.hpp"

namespace palpate::bench {
namespace {

/// A whole tick; the argument is the number of substeps. The bar goes on swinging, and every tick costs the
/// same.
void whole_tick(benchmark::State& benchmark_state) {
  const auto substeps = static_cast<int>(benchmark_state.range(0));
  const auto bar = make_bent_bar(substeps);
  const TickInput input = pulling_input(bar_parameters(substeps));
  TickOutput output{};
  NoProbe probe;
  const NsPerTet report(benchmark_state, bar->forest.leaf_count);
  for ([[maybe_unused]] auto _ : benchmark_state) {
    tick(*bar, input, output, probe);
    benchmark::DoNotOptimize(output);
  }
}
BENCHMARK(whole_tick)->ArgName("substeps")->Arg(1)->Arg(3)->Unit(benchmark::kMicrosecond);

/// What a golden run or a test pays for comparing states; it is not part of a tick.
void state_hash_of_all(benchmark::State& benchmark_state) {
  const auto bar = make_bent_bar(1);
  const TickOutput output{};
  const NsPerTet report(benchmark_state, bar->forest.leaf_count);
  for ([[maybe_unused]] auto _ : benchmark_state) benchmark::DoNotOptimize(state_hash(*bar, output));
}
BENCHMARK(state_hash_of_all)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace palpate::bench
