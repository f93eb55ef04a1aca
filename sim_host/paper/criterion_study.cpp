#include "paper/criterion_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "paper/parallel.hpp"
#include "paper/rest_solution.hpp"
#include "paper/threshold_search.hpp"

namespace palpate::sim {
namespace {

using Parameters = std::vector<std::pair<std::string, std::string>>;

constexpr int kLeastLevel = 3;

Parameters joined(Parameters first, const Parameters& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

struct Criterion {
  const char* name;
  double coarse, fine;  // thresholds: a mesh hardly refined, and one of over half of the finest one's tets
};

constexpr std::array<Criterion, 3> kCriteria = {
    {{"six-edges", 0.4, 0.02}, {"longest-edge", 0.05, 0.001}, {"strain-jump", 0.5, 0.02}}};

struct Load {
  const char* name;
  const char* scenario;
  Parameters parameters;
};

const std::array<Load, 3> kLoads = {
    {{"bend", "cuboid-bend", {}},
     {"corner", "cuboid-sine", {{"rest_at_peak", "on"}}},
     {"indentation", "cuboid-sine", {{"rest_at_peak", "on"}, {"hold", "both"}, {"amplitude_mm", "20"}}}}};

/// A mesh that may be refined so far.
struct Depth {
  int finest_level;
  Parameters parameters;
};

std::vector<Depth> depths() {
  const Parameters common = {{"profile", "workstation"}, {"theta", kPaperRowTheta}};
  // Level 9 needs the density of tissue to be stable, and moves ten times slower for it.
  return {{6, joined(common, {{"ticks", "5000"}})},
          {9, joined(common, {{"density_kg_m3", "1000"},
                              {"substeps", "1"},
                              {"settle_damping_per_s", "3"},
                              {"ticks", "6000"}})}};
}

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

struct LoadedBody {
  Load load;
  Depth depth;
  std::vector<RestSolution> uniform;  // the finest first
};

double force_error_percent(const RestSolution& rest, const RestSolution& finest) {
  if (finest.reaction_n == 0.0) return 0.0;
  return 100.0 * std::abs(rest.reaction_n / finest.reaction_n - 1.0);
}

StudyCurve uniform_curve(const std::vector<RestSolution>& solutions) {
  StudyCurve curve{kUniformMesh, {}};
  const RestSolution& finest = solutions.front();
  for (std::size_t i = solutions.size(); i-- > 1;) {
    const auto tets = static_cast<double>(solutions[i].body.tets.size());
    curve.points.push_back({0.0, tets, error_of(solutions[i].body, finest.body, finest.is_free),
                            force_error_percent(solutions[i], finest), 0.0, 0.0, 0.0, ""});
  }
  return curve;
}

RunRequest request_of(const Experiment& experiment, const LoadedBody& body, const std::string& criterion,
                      double threshold) {
  const std::string text = fmt::format("{:.3g}", threshold);
  const Parameters mesh = {{"level", std::to_string(kLeastLevel)},
                           {"least_level", std::to_string(kLeastLevel)},
                           {"most_level", std::to_string(body.depth.finest_level)},
                           {"stretch", criterion},
                           {"stretch_split", text}};
  const std::string name =
      fmt::format("rest-{}-{}-{}-{}", body.load.name, body.depth.finest_level, criterion, text);
  return experiment.request(name, body.load.scenario,
                            joined(joined(body.depth.parameters, body.load.parameters), mesh));
}

StudyPoint run_point(const Experiment& experiment, const RunRequest& request, double threshold,
                     const RestSolution& finest) {
  const Trace trace = trace_run(request, experiment.runs());
  const RestSolution rest = solve_rest(scenario_of(request), trace.last);
  return {threshold,
          static_cast<double>(trace.tets.back()),
          error_of(rest.body, finest.body, finest.is_free),
          force_error_percent(rest, finest),
          error_of(trace.last, rest.body, rest.is_free).mean_mm,
          trace.remesh_ns(),
          trace.tick_ns(),
          command_of(request)};
}

StudyCurve run_curve(const Experiment& experiment, const LoadedBody& body, const Criterion& criterion) {
  constexpr std::size_t kMostPoints = 14;
  const RestSolution& finest = body.uniform.front();
  const double half = 0.5 * static_cast<double>(finest.body.tets.size());
  StudyCurve curve{criterion.name, {}};
  std::vector<StudyPoint>& points = curve.points;
  const auto add = [&](double threshold) {
    const RunRequest request = request_of(experiment, body, criterion.name, threshold);
    const auto place = std::find_if(points.begin(), points.end(),
                                    [&](const StudyPoint& point) { return point.threshold < threshold; });
    points.insert(place, run_point(experiment, request, threshold, finest));
  };
  add(criterion.coarse);
  add(criterion.fine);
  while (!experiment.is_quick && points.size() < kMostPoints) {
    const double next = next_threshold(points, half);
    if (next == 0.0) break;
    add(next);
  }
  std::stable_sort(points.begin(), points.end(),
                   [](const StudyPoint& a, const StudyPoint& b) { return a.tets < b.tets; });
  return curve;
}

}  // namespace

std::vector<LoadStudy> study_criteria(const Experiment& experiment) {
  std::vector<LoadedBody> bodies;
  for (const Depth& depth : depths()) {
    if (experiment.is_quick && depth.finest_level > 6) continue;
    for (const Load& load : kLoads) {
      print_line(fmt::format("  {} at rest on uniform meshes up to level {}", load.name, depth.finest_level));
      bodies.push_back({load, depth, solve_uniform(load, depth)});
    }
  }
  std::vector<std::pair<std::size_t, Criterion>> planned;
  for (std::size_t i = bodies.size(); i-- > 0;)  // the longest first
    for (const Criterion& criterion : kCriteria) planned.emplace_back(i, criterion);
  const std::vector<StudyCurve> curves = in_parallel(
      planned, [&](const auto& one) { return run_curve(experiment, bodies[one.first], one.second); });
  std::vector<LoadStudy> studies;
  studies.reserve(bodies.size());
  for (const LoadedBody& body : bodies)
    studies.push_back({body.load.name,
                       body.depth.finest_level,
                       body.uniform.front().reaction_n > 0.0,
                       {uniform_curve(body.uniform)}});
  for (std::size_t i = 0; i < curves.size(); ++i) studies[planned[i].first].curves.push_back(curves[i]);
  return studies;
}

double error_at(const StudyCurve& curve, double tets, StudyError which) {
  const auto error = [which](const StudyPoint& point) {
    constexpr double kLeastMm = 1e-3;
    constexpr double kLeastPercent = 1.0;
    return which == StudyError::kMeanMm ? std::max(point.error.mean_mm, kLeastMm)
                                        : std::max(point.force_percent, kLeastPercent);
  };
  const auto& points = curve.points;
  if (points.empty() || tets < points.front().tets) return std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < points.size(); ++i) {
    const StudyPoint& a = points[i - 1];
    const StudyPoint& b = points[i];
    if (tets >= b.tets || b.tets <= a.tets) continue;
    if (b.tets > kNearTets * a.tets) return error(a);
    const double part = std::log(tets / a.tets) / std::log(b.tets / a.tets);
    return std::exp((1.0 - part) * std::log(error(a)) + part * std::log(error(b)));
  }
  return error(points.back());
}

}  // namespace palpate::sim
