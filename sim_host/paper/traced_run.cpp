#include "paper/traced_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "output/plots.hpp"
#include "output/projection.hpp"
#include "palpate/tick/stage.hpp"
#include "paper/parallel.hpp"
#include "scenario/parameter_table.hpp"
#include "simulation/capacity.hpp"

namespace palpate::sim {
namespace {

constexpr auto kRemeshStage = static_cast<std::size_t>(CoreStage::kRemesh);

/// The node that rests in the middle of the far end of the longest axis.
std::optional<std::size_t> middle_of_end(const BodyShape& shape) {
  Point3 high = {0, 0, 0};
  for (const Point3& p : shape.rest_mm) {
    for (std::size_t axis = 0; axis < 3; ++axis) high[axis] = std::max(high[axis], p[axis]);
  }
  const Point3 middle = {high[0] / 2, high[1] / 2, high[2]};
  for (std::size_t i = 0; i < shape.rest_mm.size(); ++i) {
    if (length(minus(shape.rest_mm[i], middle)) < 1e-6) return i;
  }
  return std::nullopt;
}

/// Fills a trace while a run is recorded.
class Watcher {
 public:
  Watcher(const Simulation& simulation, Trace& trace) : simulation_(simulation), trace_(trace) {}

  void look(const Sample& sample) {
    trace_.force_n.push_back(sample.force_n);
    trace_.tets.push_back(sample.tets);
    trace_.rotation_tets.push_back(sample.rotation_tets);
    const double spent_ms = simulation_.stage_ms()[kRemeshStage];
    trace_.remesh_ms.push_back(spent_ms - spent_before_ms_);
    spent_before_ms_ = spent_ms;
    if (sample.tick % kEndEvery == 0) look_at_end(sample.tick);
    keep_farthest(sample);
  }

 private:
  void look_at_end(uint32_t tick) {
    const BodyShape shape = simulation_.shape();
    const auto node = middle_of_end(shape);
    if (node) trace_.end_mm.push_back({tick * 1e-3, shape.now_mm[*node][1] - shape.rest_mm[*node][1]});
  }
  void keep_farthest(const Sample& sample) {
    constexpr uint32_t kEvery = 10;  // the sine's peaks are among them
    const double distance = length(sample.displacement_mm);
    if (sample.tick % kEvery != 1 || distance < farthest_mm_) return;
    farthest_mm_ = distance;
    trace_.farthest = simulation_.fields();
  }

  const Simulation& simulation_;
  Trace& trace_;
  double spent_before_ms_ = 0.0;
  double farthest_mm_ = 0.0;
};

}  // namespace

std::string command_of(const RunRequest& request) {
  std::string text = "palpate run " + request.scenario;
  for (const auto& [key, value] : request.parameters) {
    std::string flag = key;
    std::replace(flag.begin(), flag.end(), '_', '-');
    text += fmt::format(" --{} {}", flag, value);
  }
  return text;
}

Scenario scenario_of(const RunRequest& request) {
  Scenario scenario = built_in_scenario(request.scenario);
  scenario.plots = false;
  for (const auto& [key, value] : request.parameters) {
    const Parameter* parameter = find_parameter(key);
    if (parameter == nullptr) throw BadInput(fmt::format("{} has no key '{}'", request.scenario, key));
    set_parameter(scenario, *parameter, value, "--");
  }
  complete_scenario(scenario);
  fit_to_profile(scenario);
  return scenario;
}

double Trace::peak_n() const {
  double peak = 0.0;
  for (const Point3& force : force_n) peak = std::max(peak, length(force));
  return peak;
}

namespace {

double ns_a_tick_and_tet(double ms, const Trace& trace) {
  constexpr double kNsOfMs = 1e6;
  return kNsOfMs * ms / std::max(1.0, std::accumulate(trace.tets.begin(), trace.tets.end(), 0.0));
}

}  // namespace

double Trace::remesh_ns() const {
  return ns_a_tick_and_tet(std::accumulate(remesh_ms.begin(), remesh_ms.end(), 0.0), *this);
}

double Trace::tick_ns() const { return ns_a_tick_and_tet(all_ms, *this); }

Trace trace_run(const RunRequest& request, const std::filesystem::path& folder) {
  Scenario scenario = scenario_of(request);
  scenario.out = (folder / request.name).string();
  const auto simulation = make_tool_simulation(scenario);
  Trace trace;
  trace.request = request;
  Watcher watcher(*simulation, trace);
  RunFolder run(scenario.out);
  const Recording recording =
      record(*simulation, scenario, run, [&](const Sample& sample) { watcher.look(sample); });
  write_summary(recording, *simulation, scenario, run.file("summary.json"));
  if (scenario.plots) draw_plots(recording, simulation->has_device(), run);
  run.commit();
  trace.last = simulation->fields();
  const auto stages = simulation->stage_ms();
  trace.all_ms = std::accumulate(stages.begin(), stages.end(), 0.0);
  trace.totals = simulation->totals();
  trace.all_flags = recording.all_flags;
  trace.failure = simulation->failure();
  print_line(
      fmt::format("  {:<38} {:6} ticks {:6.1f} s", request.name, trace.force_n.size(), recording.duration_s));
  return trace;
}

std::vector<Trace> trace_runs(const std::vector<RunRequest>& requests, const std::filesystem::path& folder) {
  return in_parallel(requests, [&](const RunRequest& request) { return trace_run(request, folder); });
}

}  // namespace palpate::sim
