#include "paper/sine_runs.hpp"

#include <algorithm>
#include <stdexcept>

#include "paper/parallel.hpp"

namespace palpate::sim {
namespace {

using Parameters = std::vector<std::pair<std::string, std::string>>;

const Parameters kCorner = {};
const Parameters kIndentation = {{"hold", "both"}, {"amplitude_mm", "20"}};
const Parameters kFull = {{"profile", "workstation"}, {"rotations", "full"}};
const Parameters kFine = {{"profile", "workstation"}, {"theta", kPaperRowTheta}};
const Parameters kAtPaperTheta = {{"profile", "workstation"}, {"theta", kPaperTheta}};
const Parameters kWorkstation = {{"profile", "workstation"}};
const Parameters kOnChip = {};
const Parameters kMoving = {{"stretch", "six-edges"}, {"least_level", "3"}};
const Parameters kSeries = {{"vtu_every", "250"}, {"plots", "on"}};

Parameters joined(const std::vector<Parameters>& parts) {
  Parameters all;
  for (const Parameters& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// The longest ones first, so that no thread is left alone with one.
std::vector<RunRequest> requests_of(const Experiment& experiment) {
  std::vector<RunRequest> requests;
  const auto sine = [&](const std::string& name, const std::vector<Parameters>& parts) {
    requests.push_back(experiment.request(name, "cuboid-sine", joined(parts)));
  };
  sine("corner-full", {kCorner, kFull});
  sine("indentation-full", {kIndentation, kFull});
  sine("corner-fine", {kCorner, kFine});
  sine("indentation-fine", {kIndentation, kFine});
  sine("corner-paper-theta", {kCorner, kAtPaperTheta});
  sine("indentation-paper-theta", {kIndentation, kAtPaperTheta});
  sine("corner-default", {kCorner, kWorkstation});
  sine("corner-on-chip", {kCorner, kOnChip, kSeries});
  sine("indentation-on-chip", {kIndentation, kOnChip});
  sine("corner-fine-moving", {kCorner, kFine, kMoving});
  sine("indentation-fine-moving", {kIndentation, kFine, kMoving, kSeries});
  requests.push_back(
      experiment.request("bend", "cuboid-bend", joined({kOnChip, {{"vtu_every", "200"}, {"plots", "on"}}})));
  requests.push_back(experiment.request("bend-fine", "cuboid-bend", kFine));
  return requests;
}

Trace take(std::vector<Trace>& traces, const std::string& name) {
  const auto found = std::find_if(traces.begin(), traces.end(),
                                  [&](const Trace& trace) { return trace.request.name == name; });
  if (found == traces.end()) throw std::logic_error("no run is called " + name);
  return std::move(*found);
}

/// Alone on the machine, since the time of their re-mesh stage is reported.
Trace run_alone(const Experiment& experiment, const std::string& name, const Parameters& motion) {
  const RunRequest request =
      experiment.request(name, "cuboid-sine", joined({motion, kOnChip, kMoving, kSeries}));
  return std::move(trace_runs({request}, experiment.runs()).front());
}

SineRuns take_motion(const Experiment& experiment, std::vector<Trace>& traces, const std::string& name,
                     const std::string& what, const Parameters& motion) {
  return SineRuns{what,
                  take(traces, name + "-full"),
                  take(traces, name + "-paper-theta"),
                  take(traces, name + "-fine"),
                  take(traces, name + "-fine-moving"),
                  take(traces, name + "-on-chip"),
                  run_alone(experiment, name + "-on-chip-moving", motion)};
}

}  // namespace

PaperRuns run_sines(const Experiment& experiment) {
  std::vector<Trace> traces = trace_runs(requests_of(experiment), experiment.runs());
  const Scenario scenario = scenario_of(experiment.request("models", "cuboid-sine", kCorner));
  const std::vector<reference::ElasticModel> models = {reference::ElasticModel::kLinear,
                                                       reference::ElasticModel::kStVenantKirchhoff};
  std::vector<ModelTrace> of_models =
      in_parallel(models, [&](reference::ElasticModel model) { return trace_model(scenario, model); });
  return PaperRuns{
      take_motion(experiment, traces, "corner", "corner of the free end", kCorner),
      take_motion(experiment, traces, "indentation", "middle of a side, both ends held", kIndentation),
      take(traces, "corner-default"),
      std::move(of_models[0]),
      std::move(of_models[1]),
      take(traces, "bend"),
      take(traces, "bend-fine")};
}

}  // namespace palpate::sim
