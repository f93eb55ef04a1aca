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

Parameters joined(Parameters first, const Parameters& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

struct Choice {
  const char* criterion;
  std::vector<const char*> thresholds;
};

struct Load {
  const char* name;
  const char* scenario;
  Parameters parameters;
  std::vector<Choice> choices;
};

/// A mesh that may be refined so far, and the loads on it.
struct Depth {
  int finest_level;
  Parameters parameters;
  std::vector<Load> loads;
};

std::vector<Load> loads_with(const std::array<std::vector<Choice>, 3>& choices) {
  return {{"bend", "cuboid-bend", {}, choices[0]},
          {"corner", "cuboid-sine", {{"rest_at_peak", "on"}}, choices[1]},
          {"indentation",
           "cuboid-sine",
           {{"rest_at_peak", "on"}, {"hold", "both"}, {"amplitude_mm", "20"}},
           choices[2]}};
}

/// Thresholds that lead from meshes that are hardly refined to most of the tets of the uniform mesh, so that
/// the curves of all criteria share a wide range. Some neighbours are far apart all the same: in the bend to
/// level 9 longest-edge splits nothing at 0.033 and ends with 5900 tets at 0.03.
std::vector<Depth> depths() {
  const std::vector<Load> to_6 =
      loads_with({{{{"six-edges", {"0.3", "0.2", "0.15", "0.13", "0.1", "0.07"}},
                    {"longest-edge", {"0.008", "0.006", "0.005", "0.002"}},
                    {"strain-jump", {"0.4", "0.3", "0.2", "0.15", "0.1"}}},
                   {{"six-edges", {"0.1", "0.07", "0.05", "0.03", "0.02", "0.015"}},
                    {"longest-edge", {"0.015", "0.01", "0.005", "0.002", "0.001"}},
                    {"strain-jump", {"0.1", "0.07", "0.05", "0.03", "0.02", "0.015"}}},
                   {{"six-edges", {"0.1", "0.07", "0.05", "0.04", "0.03"}},
                    {"longest-edge", {"0.03", "0.02", "0.01", "0.005", "0.001"}},
                    {"strain-jump", {"0.15", "0.1", "0.05", "0.035", "0.03"}}}}});
  const std::vector<Load> to_9 = loads_with({{{{"six-edges", {"0.3", "0.25", "0.2", "0.16", "0.1"}},
                                               {"longest-edge", {"0.04", "0.03", "0.008"}},
                                               {"strain-jump", {"0.4", "0.3", "0.25", "0.2", "0.1"}}},
                                              {{"six-edges", {"0.14", "0.1", "0.07", "0.05", "0.03"}},
                                               {"longest-edge", {"0.03", "0.025", "0.02", "0.012"}},
                                               {"strain-jump", {"0.1", "0.07", "0.05", "0.03", "0.02"}}},
                                              {{"six-edges", {"0.1", "0.05", "0.035", "0.03"}},
                                               {"longest-edge", {"0.03", "0.025", "0.02", "0.008"}},
                                               {"strain-jump", {"0.1", "0.07", "0.04", "0.03", "0.02"}}}}});
  const Parameters common = {{"profile", "workstation"}, {"theta", kPaperRowTheta}};
  // Level 9 needs the density of tissue to be stable, and moves ten times slower for it.
  const Parameters light = joined(common, {{"ticks", "5000"}});
  const Parameters heavy = joined(
      common,
      {{"density_kg_m3", "1000"}, {"substeps", "1"}, {"settle_damping_per_s", "3"}, {"ticks", "6000"}});
  return {{6, light, to_6}, {9, heavy, to_9}};
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
  StudyCurve curve{kUniformMesh, {}};
  const RestSolution& finest = solutions.front();
  for (std::size_t i = solutions.size(); i-- > 1;) {
    const auto tets = static_cast<uint32_t>(solutions[i].body.tets.size());
    curve.points.push_back({0.0, static_cast<double>(tets), tets,
                            error_of(solutions[i].body, finest.body, finest.is_free), 0.0, 0.0, ""});
  }
  return curve;
}

std::vector<Planned> plan(const Experiment& experiment, const Load& load, const Depth& depth,
                          std::size_t study) {
  std::vector<Planned> all;
  for (const Choice& choice : load.choices) {
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

StudyPoint run_point(const Experiment& experiment, const Planned& planned, const RestSolution& finest) {
  const Trace trace = trace_run(planned.request, experiment.runs());
  const RestSolution rest = solve_rest(scenario_of(planned.request), trace.last);
  return {planned.threshold,
          trace.mean_tets(),
          trace.tets.back(),
          error_of(rest.body, finest.body, finest.is_free),
          error_of(trace.last, rest.body, rest.is_free).mean_mm,
          trace.remesh_ns(),
          command_of(planned.request)};
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
    for (const Load& load : depth.loads) {
      print_line(fmt::format("  {} at rest on uniform meshes up to level {}", load.name, depth.finest_level));
      const std::vector<RestSolution> solutions = solve_uniform(load, depth);
      const std::vector<Planned> runs = plan(experiment, load, depth, studies.size());
      planned.insert(planned.end(), runs.begin(), runs.end());
      studies.push_back({load.name, depth.finest_level, {uniform_curve(solutions)}});
      finest.push_back(solutions.front());
    }
  }
  const std::vector<StudyPoint> points =
      in_parallel(planned, [&](const Planned& one) { return run_point(experiment, one, finest[one.study]); });
  for (std::size_t i = 0; i < points.size(); ++i) {
    add_point(studies[planned[i].study], planned[i].criterion, points[i]);
  }
  for (LoadStudy& study : studies) sort_by_tets(study);
  return studies;
}

double error_at(const StudyCurve& curve, double tets) {
  constexpr double kLeastMm = 1e-3;  // what is below is equally good
  constexpr double kWidestGap = 3.0;
  const auto& points = curve.points;
  if (points.empty() || tets < points.front().mean_tets) return std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < points.size(); ++i) {
    const StudyPoint& a = points[i - 1];
    const StudyPoint& b = points[i];
    if (tets >= b.mean_tets || b.mean_tets <= a.mean_tets) continue;
    if (b.mean_tets > kWidestGap * a.mean_tets) return std::max(a.error.mean_mm, kLeastMm);
    const double part = std::log(tets / a.mean_tets) / std::log(b.mean_tets / a.mean_tets);
    return std::exp((1.0 - part) * std::log(std::max(a.error.mean_mm, kLeastMm)) +
                    part * std::log(std::max(b.error.mean_mm, kLeastMm)));
  }
  return std::max(points.back().error.mean_mm, kLeastMm);
}

}  // namespace palpate::sim
