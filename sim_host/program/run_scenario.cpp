#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>

#include "hil/device_log.hpp"
#include "hil/link_run.hpp"
#include "hil/plant_simulation.hpp"
#include "hil/touch_task.hpp"
#include "output/gnuplot.hpp"
#include "output/plots.hpp"
#include "output/progress.hpp"
#include "output/recorder.hpp"
#include "program/commands.hpp"
#include "simulation/capacity.hpp"

namespace palpate::sim {
namespace {

bool is_hil(const std::string& command) { return command == "hil"; }

void require_kind(const Scenario& scenario, const std::string& command) {
  const bool needs_device = has_device(scenario.kind);
  if (scenario.board == "qemu" && scenario.kind != ScenarioKind::kTouch) {
    throw BadInput(
        fmt::format("board qemu runs touch; the firmware that plays {} is built with its script, see "
                    "./dev demo",
                    kind_name(scenario.kind)));
  }
  if (needs_device == is_hil(command)) return;
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
  if (simulation.has_device()) {
    const SceneParameters& scene = scenario.scene;
    fmt::print("  device      turned by {:g} deg, at {:g} m; motion x {:g}, force x {:g}, work x {:g}\n",
               fmt::join(scene.device_rotation_deg, ", "), fmt::join(scene.body_centre_in_device_m, ", "),
               scene.motion_scale, scene.force_scale, scene.work_scale());
  }
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

std::unique_ptr<Simulation> make_simulation(const Scenario& scenario, const std::string& command,
                                            std::optional<DeviceLog>& log) {
  if (!is_hil(command)) return make_tool_simulation(scenario);
  if (scenario.kind == ScenarioKind::kGrasp) return make_device_simulation(scenario);
  return make_plant_simulation(scenario, [&log](const ClosedLoop& loop) { log->add(loop); });
}

/// Only the device is here: what the body did is in the firmware's console, which a bench does not send.
int run_behind_link(const Scenario& scenario) {
  RunFolder folder(scenario.out);
  Progress progress(touch_ticks(scenario));
  const LinkRun run = run_over_link(scenario, folder, [&progress](uint32_t tick) { progress.show(tick); });
  write_link_summary(run, scenario, folder.file("summary.json"));
  folder.commit();
  fmt::print("{}: {} ticks in {:.1f} s, {}\n", scenario.name, run.ticks, run.duration_s,
             scenario.port.empty() ? "in QEMU over " + scenario.link : "over " + scenario.port);
  fmt::print("  safety      {} at the end\n", run.last_state);
  fmt::print("  hand force  at most {:.3f} N\n", run.peak_hand_force_n);
  fmt::print("  state hash  {}\n", run.state_hash);
  fmt::print("  written to  {}\n", scenario.out);
  return 0;
}

/// Each value that nobody has verified, once.
void print_doubtful_figures(const plant::Plant& plant) {
  for (const plant::Figure& figure : plant.doubtful_figures()) {
    fmt::print(stderr, "palpate: warning: {} = {:g} {} is {}: {}\n", figure.name, figure.value, figure.unit,
               figure.mark == plant::Mark::kAssumed ? "assumed" : "unverified", figure.source);
  }
}

int run_here(const Scenario& scenario, const std::string& command) {
  RunFolder folder(scenario.out);
  std::optional<DeviceLog> log;
  if (scenario.kind == ScenarioKind::kTouch) log.emplace(folder.file("device.csv"));
  const auto simulation = make_simulation(scenario, command, log);
  const Recording recording = record_with_progress(*simulation, scenario, folder);
  if (log) log->close();
  write_summary(recording, *simulation, scenario, folder.file("summary.json"));
  if (scenario.plots) draw_plots(recording, simulation->has_device(), folder);
  folder.commit();
  print_result(recording, *simulation, scenario);
  const auto failure = simulation->failure();
  if (failure) fmt::print(stderr, "palpate: {}\n", *failure);
  return failure ? 1 : 0;
}

}  // namespace

int run_scenario(Scenario scenario, const std::string& command) {
  require_kind(scenario, command);
  complete_scenario(scenario);
  fit_to_profile(scenario);
  if (scenario.out.empty()) scenario.out = fmt::format("out/{}/{}", command, scenario.name);
  if (scenario.kind == ScenarioKind::kTouch) print_doubtful_figures(touch_plant(scenario));
  if (scenario.board == "qemu" || !scenario.port.empty()) return run_behind_link(scenario);
  if (scenario.plots) require_gnuplot();
  return run_here(scenario, command);
}

}  // namespace palpate::sim
