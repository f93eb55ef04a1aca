#include "paper/bar_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "domain.hpp"
#include "output/interrupt.hpp"
#include "scenario/errors.hpp"
#include "simulation/capacity.hpp"

namespace palpate::sim {
namespace {

constexpr const char* kMisfit = "misfit";
/// Two thresholds this near are one.
constexpr double kSameTheta = 1.005;
/// As long as no run has more tets than wanted.
constexpr double kStepDown = 2.0;

/// Times of stages in slices of the run, whose medians leave out what else the machine did.
class StageTimes {
 public:
  void look(const Simulation& simulation, uint32_t tick) {
    if (tick % RestRun::kSliceTicks != 0) return;
    const std::vector<double> now = simulation.stage_ms();
    slices_.resize(now.size());
    before_.resize(now.size(), 0.0);
    for (std::size_t i = 0; i < now.size(); ++i)
      slices_[i].push_back((now[i] - before_[i]) / RestRun::kSliceTicks);
    before_ = now;
  }

  /// Of a tick, by stage.
  [[nodiscard]] std::vector<double> medians_ms() const {
    std::vector<double> medians;
    for (std::vector<double> slices : slices_) {
      const auto middle = slices.begin() + static_cast<std::ptrdiff_t>(slices.size() / 2);
      std::nth_element(slices.begin(), middle, slices.end());
      medians.push_back(*middle);
    }
    return medians;
  }

 private:
  std::vector<std::vector<double>> slices_;  // a stage
  std::vector<double> before_;
};

RestRun run_to_rest(const Scenario& scenario, StatusLine& status) {
  const auto simulation = make_tool_simulation(scenario);
  StageTimes times;
  Sample sample{};
  for (bool goes_on = true; goes_on;) {
    if (is_interrupted()) throw Interrupted();
    goes_on = simulation->advance();
    sample = simulation->sample();
    times.look(*simulation, sample.tick);
    status.show(fmt::format("theta {:.3g} deg, tick {}, {} rotation tets",
                            scenario.model.remesh.rotation_split_deg, sample.tick, sample.rotation_tets));
  }
  return RestRun{scenario.rotations,   scenario.model.remesh.rotation_split_deg,
                 sample.rotation_tets, sample.tick,
                 simulation->fields(), simulation->shape(),
                 times.medians_ms(),   simulation->failure()};
}

}  // namespace

const RestRun& BarRuns::run(const std::string& rotations, double theta_deg) {
  if (const RestRun* done = find(rotations, theta_deg)) return *done;
  Scenario scenario = scenario_;
  scenario.rotations = rotations;
  scenario.model.remesh.rotation_split_deg = theta_deg;
  complete_scenario(scenario);
  runs_.push_back(run_to_rest(scenario, status_));
  return runs_.back();
}

const RestRun* BarRuns::find(const std::string& rotations, double theta_deg) const {
  const auto found = std::find_if(runs_.begin(), runs_.end(), [&](const RestRun& run) {
    return run.rotations == rotations && run.theta_deg == theta_deg;
  });
  return found == runs_.end() ? nullptr : &*found;
}

const RestRun* BarRuns::best_up_to(uint32_t count) const {
  const RestRun* best = nullptr;
  for (const RestRun& run : runs_) {
    const bool is_candidate = run.rotations == kMisfit && run.rotation_tets <= count && !run.failure;
    if (!is_candidate) continue;
    const auto rank = [](const RestRun& of) { return std::pair(of.rotation_tets, -of.theta_deg); };
    if (best == nullptr || rank(run) > rank(*best)) best = &run;
  }
  return best;
}

std::optional<double> BarRuns::next_theta(uint32_t count) const {
  const Range& range = domain::kRotationSplitDeg;
  const RestRun* best = best_up_to(count);
  if (best != nullptr && best->rotation_tets == count) return std::nullopt;
  double above = 0.0;  // the largest theta with too many tets, though smaller than the best one
  double lowest = range.high * kStepDown;
  for (const RestRun& run : runs_) {
    if (run.rotations != kMisfit) continue;
    lowest = std::min(lowest, run.theta_deg);
    const bool has_too_many = run.rotation_tets > count;
    if (has_too_many && (best == nullptr || run.theta_deg < best->theta_deg)) {
      above = std::max(above, run.theta_deg);
    }
  }
  double next = 0.0;
  if (best == nullptr) {
    next = range.high;
  } else if (above == 0.0) {
    next = std::max(range.low, lowest / kStepDown);
  } else if (best->theta_deg > above * kSameTheta) {
    next = std::sqrt(best->theta_deg * above);
  }
  if (next == 0.0 || find(kMisfit, next) != nullptr) return std::nullopt;
  return next;
}

const RestRun& BarRuns::most_tets_up_to(uint32_t count) {
  while (const auto theta_deg = next_theta(count)) run(kMisfit, *theta_deg);
  if (const RestRun* best = best_up_to(count)) return *best;
  throw std::runtime_error(fmt::format("no run with at most {} rotation tets comes to rest", count));
}

Scenario bar_scenario(double bend_deg, double twist_deg) {
  Scenario scenario = built_in_scenario("cuboid-bend");
  scenario.profile = "workstation";
  scenario.bend.angle_deg = bend_deg;
  scenario.bend.twist_deg = twist_deg;
  complete_scenario(scenario);
  fit_to_profile(scenario);
  return scenario;
}

}  // namespace palpate::sim
