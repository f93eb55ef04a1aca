#include "bent_bar.hpp"
#include "palpate/firmware/cycle.hpp"

namespace palpate::bench {
namespace {

firmware::CycleModel bar_beside_the_tool(int substeps) {
  const sim::ModelParameters parameters = bar_parameters(substeps);
  sim::SceneParameters scene;
  // At zero counts the tool is at (215, 0, -170) mm: on the bar's side, 64 mm above its middle.
  scene.body_centre_in_device_m = {0.183, 0.0, -0.234};
  return {sim::compile_model(parameters), sim::compile_scene(scene, parameters)};
}

/// Encoder counts to motor codes with a tick between; the argument is the number of substeps. The turret
/// swings over 30 mm while the bar is grasped.
void whole_cycle(benchmark::State& benchmark_state) {
  constexpr int32_t kSwingCounts = 600;
  auto state = std::make_unique<firmware::CycleState<Profile>>();
  if (firmware::start(*state, bar_beside_the_tool(static_cast<int>(benchmark_state.range(0)))) !=
      Status::kDone) {
    benchmark_state.SkipWithError("the bar does not fit its profile");
    return;
  }
  firmware::Actuators actuators{};
  firmware::NoProbe probe;
  int32_t at = 0;
  const NsPerTet report(benchmark_state, state->core.forest.leaf_count);
  for ([[maybe_unused]] auto _ : benchmark_state) {
    at = (at + 1) % (2 * kSwingCounts);
    const int32_t turned = at < kSwingCounts ? at : 2 * kSwingCounts - at;
    firmware::cycle(*state, firmware::Sensors{{turned, 0, 0}, true}, actuators, probe);
    benchmark::DoNotOptimize(actuators);
  }
  if (!actuators.amplifiers_enabled || !state->core.grasp.holds())
    benchmark_state.SkipWithError("nothing is grasped");
}
BENCHMARK(whole_cycle)->ArgName("substeps")->Arg(1)->Arg(3)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace palpate::bench
