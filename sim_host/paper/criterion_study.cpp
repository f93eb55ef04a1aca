#include "paper/criterion_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "paper/parallel.hpp"
#include "paper/rest_solution.hpp"

namespace palpate::sim {
namespace {

using Parameters = std::vector<std::pair<std::string, std::string>>;

constexpr int kLeastLevel = 3;

struct Load {
  const char* name;
  const char* scenario;
  Parameters parameters;
};

/// Everything but the load, the criterion and its threshold.
struct Depth {
  int finest_level;
  Parameters parameters;
};

struct Choice {
  const char* criterion;
  std::vector<const char*> thresholds;
};

std::vector<Load> loads() {
  return {{"bend", "cuboid-bend", {}},
          {"corner", "cuboid-sine", {{"rest_at_peak", "on"}}},
          {"indentation", "cuboid-sine", {{"rest_at_peak", "on"}, {"hold", "both"}, {"amplitude_mm", "20"}}}};
}

/// Level 9 needs the density of tissue to be stable, and moves ten times slower for it.
std::vector<Depth> depths() {
  const Parameters common = {{"profile", "workstation"}, {"theta", kPaperRowTheta}};
  Parameters deep = common;
  deep.insert(
      deep.end(),
      {{"density_kg_m3", "1000"}, {"substeps", "1"}, {"settle_damping_per_s", "3"}, {"ticks", "8000"}});
  return {{6, common}, {9, deep}};
}

std::vector<Choice> choices(int finest_level) {
  if (finest_level == 6) {
    return {{"six-edges", {"0.02", "0.05", "0.1", "0.2"}},
            {"longest-edge", {"0.01", "0.02", "0.05", "0.1"}},
            {"strain-jump", {"0.05", "0.1", "0.2", "0.4"}}};
  }
  return {{"six-edges", {"0.1", "0.2"}}, {"longest-edge", {"0.05", "0.1"}}, {"strain-jump", {"0.2", "0.4"}}};
}

Parameters joined(Parameters first, const Parameters& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

struct Planned {
  RunRequest request;
  std::size_t study;
  std::string criterion;
  double threshold;
};

/// The bodies at rest on uniform meshes, the finest one first.
std::vector<RestSolution> solve_uniform(const Load& load, const Depth& depth) {
  std::vector<int> levels;
  for (int level = depth.finest_level; level >= kLeastLevel; --level) levels.push_back(level);
  return in_parallel(levels, [&](int level) {
    const RunRequest request{
        "", load.scenario,
        joined(joined(depth.parameters, load.parameters), {{"level", std::to_string(level)}})};
    return solve_rest(scenario_of(request));
  });
}

StudyCurve uniform_curve(const std::vector<RestSolution>& solutions) {
  StudyCurve curve{"uniform mesh", {}};
  const RestSolution& finest = solutions.front();
  for (std::size_t i = solutions.size(); i-- > 1;) {
    const auto tets = static_cast<uint32_t>(solutions[i].body.tets.size());
    curve.points.push_back({0.0, static_cast<double>(tets), tets,
                            error_of(solutions[i].body, finest.body, finest.is_free), true, ""});
  }
  return curve;
}

std::vector<Planned> plan(const Experiment& experiment, const Load& load, const Depth& depth,
                          std::size_t study) {
  std::vector<Planned> all;
  for (const Choice& choice : choices(depth.finest_level)) {
    for (const char* threshold : choice.thresholds) {
      const Parameters mesh = {{"level", std::to_string(kLeastLevel)},
                               {"least_level", std::to_string(kLeastLevel)},
                               {"most_level", std::to_string(depth.finest_level)},
                               {"stretch", choice.criterion},
                               {"stretch_split", threshold}};
      const std::string name =
          fmt::format("rest-{}-{}-{}-{}", load.name, depth.finest_level, choice.criterion, threshold);
      all.push_back(
          {experiment.request(name, load.scenario, joined(joined(depth.parameters, load.parameters), mesh)),
           study, choice.criterion, std::stod(threshold)});
    }
  }
  return all;
}

StudyPoint point_of(const Planned& planned, const Trace& trace, const RestSolution& finest) {
  return {planned.threshold, trace.mean_tets(),
          trace.tets.back(), error_of(trace.last, finest.body, finest.is_free),
          !trace.failure,    command_of(planned.request)};
}

void add_point(LoadStudy& study, const std::string& criterion, const StudyPoint& point) {
  const auto found = std::find_if(study.curves.begin(), study.curves.end(),
                                  [&](const StudyCurve& curve) { return curve.criterion == criterion; });
  StudyCurve& curve =
      found == study.curves.end() ? study.curves.emplace_back(StudyCurve{criterion, {}}) : *found;
  curve.points.push_back(point);
}

void sort_by_tets(LoadStudy& study) {
  for (StudyCurve& curve : study.curves) {
    std::stable_sort(curve.points.begin(), curve.points.end(),
                     [](const StudyPoint& a, const StudyPoint& b) { return a.mean_tets < b.mean_tets; });
  }
}

}  // namespace

std::vector<LoadStudy> study_criteria(const Experiment& experiment) {
  std::vector<LoadStudy> studies;
  std::vector<RestSolution> finest;
  std::vector<Planned> planned;
  for (const Depth& depth : depths()) {
    if (experiment.is_quick && depth.finest_level > 6) continue;
    for (const Load& load : loads()) {
      print_line(fmt::format("  {} at rest on uniform meshes up to level {}", load.name, depth.finest_level));
      const std::vector<RestSolution> solutions = solve_uniform(load, depth);
      const std::vector<Planned> runs = plan(experiment, load, depth, studies.size());
      planned.insert(planned.end(), runs.begin(), runs.end());
      studies.push_back({load.name, depth.finest_level, {uniform_curve(solutions)}});
      finest.push_back(solutions.front());
    }
  }
  std::vector<RunRequest> requests;
  for (const Planned& one : planned) requests.push_back(one.request);
  const std::vector<Trace> traces = trace_runs(requests, experiment.runs());
  for (std::size_t i = 0; i < traces.size(); ++i) {
    const std::size_t study = planned[i].study;
    add_point(studies[study], planned[i].criterion, point_of(planned[i], traces[i], finest[study]));
  }
  for (LoadStudy& study : studies) sort_by_tets(study);
  return studies;
}

double error_at(const StudyCurve& curve, double tets) {
  constexpr double kLeastMm = 1e-6;  // its logarithm exists
  const auto& points = curve.points;
  if (points.empty() || tets < points.front().mean_tets) return std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < points.size(); ++i) {
    const StudyPoint& a = points[i - 1];
    const StudyPoint& b = points[i];
    if (tets > b.mean_tets || b.mean_tets <= a.mean_tets) continue;
    const double part = std::log(tets / a.mean_tets) / std::log(b.mean_tets / a.mean_tets);
    return std::exp((1.0 - part) * std::log(std::max(a.error.mean_mm, kLeastMm)) +
                    part * std::log(std::max(b.error.mean_mm, kLeastMm)));
  }
  return points.back().error.mean_mm;
}

}  // namespace palpate::sim
