#include <fmt/format.h>
#include <fmt/ranges.h>

#include "output/gnuplot.hpp"
#include "output/plots.hpp"
#include "output/progress.hpp"
#include "output/recorder.hpp"
#include "program/commands.hpp"
#include "simulation/capacity.hpp"

namespace palpate::sim {
namespace {

bool has_device(const std::string& command) { return command == "hil"; }

void require_kind(const Scenario& scenario, const std::string& command) {
  const bool needs_device = scenario.kind == ScenarioKind::kGrasp;
  if (needs_device == has_device(command)) return;
  throw BadInput(needs_device
                     ? fmt::format("'{}' needs the device: use palpate hil {}", scenario.name, scenario.name)
                     : fmt::format("'{}' has no device: use palpate run {}", scenario.name, scenario.name));
}

Recording record_with_progress(Simulation& simulation, const Scenario& scenario, const RunFolder& folder) {
  Progress progress(simulation.expected_ticks());
  return record(simulation, scenario, folder, [&](const Sample& sample) { progress.show(sample.tick); });
}

/// Host time of a tick by stage.
std::string stage_times(const Simulation& simulation, uint32_t ticks) {
  const std::vector<std::string> names = simulation.hash_names();
  const std::vector<double> spent = simulation.stage_ms();
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < spent.size(); ++i) {
    parts.push_back(fmt::format("{} {:.1f}", names[i], 1e3 * spent[i] / ticks));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

void print_result(const Recording& recording, const Simulation& simulation, const Scenario& scenario) {
  const Totals totals = simulation.totals();
  fmt::print("{}: {} ticks in {:.1f} s ({:.2f} ms a tick)\n", scenario.name, recording.last.tick,
             recording.duration_s, recording.duration_s * 1e3 / recording.last.tick);
  fmt::print("  profile     {}, level {}, {} substeps\n", scenario.profile, scenario.model.level,
             scenario.model.substeps);
  fmt::print("  tets        {}, at most {} ({} bisected, {} merged)\n", totals.tets.used, totals.tets.peak,
             totals.remesh.bisected, totals.remesh.merged);
  fmt::print("  rotations   {}, at most {} ({} split, {} joined)\n", totals.rotation_tets.used,
             totals.rotation_tets.peak, totals.remesh.groups_split, totals.remesh.groups_joined);
  fmt::print("  nodes       {}, at most {}\n", totals.nodes.used, totals.nodes.peak);
  fmt::print("  peak force  {:.3f} mN\n", recording.peak_force_n * 1e3);
  fmt::print("  clamps      speed {}, position {}, strain {}\n", totals.clamps.speed, totals.clamps.position,
             totals.clamps.strain);
  fmt::print("  flags       {}\n", fmt::join(flag_names(recording.all_flags), ", "));
  fmt::print("  time, us    {}\n", stage_times(simulation, recording.last.tick));
  fmt::print("  state hash  {:016x}\n", recording.state_hash);
  fmt::print("  written to  {}\n", scenario.out);
}

}  // namespace

int run_scenario(Scenario scenario, const std::string& command) {
  require_kind(scenario, command);
  complete_scenario(scenario);
  fit_to_profile(scenario);
  const auto simulation =
      has_device(command) ? make_device_simulation(scenario) : make_tool_simulation(scenario);
  if (scenario.out.empty()) scenario.out = fmt::format("out/{}/{}", command, scenario.name);
  if (scenario.plots) require_gnuplot();
  RunFolder folder(scenario.out);
  const Recording recording = record_with_progress(*simulation, scenario, folder);
  write_summary(recording, *simulation, scenario, folder.file("summary.json"));
  if (scenario.plots) draw_plots(recording, simulation->has_device(), folder);
  folder.commit();
  print_result(recording, *simulation, scenario);
  const auto failure = simulation->failure();
  if (failure) fmt::print(stderr, "palpate: {}\n", *failure);
  return failure ? 1 : 0;
}

}  // namespace palpate::sim
