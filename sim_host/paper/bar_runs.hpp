// Runs of the fixed-point core on one pose of the bar, to rest, at different thresholds: each is made once.
#pragma once

#include <deque>
#include <string>

#include "output/status_line.hpp"
#include "scenario/scenario.hpp"
#include "simulation/simulation.hpp"

namespace palpate::sim {

/// A bar at rest.
struct RestRun {
  static constexpr uint32_t kSliceTicks = 100;

  std::string rotations;  // the criterion: misfit, siblings or full
  double theta_deg;       // theta_max
  uint32_t rotation_tets;
  uint32_t ticks;
  BodyFields fields;
  BodyShape shape;
  std::vector<double> stage_ms;  // by stage of the core: time of a tick, the median of slices of kSliceTicks
  std::optional<std::string> failure;  // why it is not at rest, if so
};

class BarRuns {
 public:
  /// `scenario` gives the body and the pose; the thresholds are the runs'. `status` must outlive this.
  BarRuns(const Scenario& scenario, StatusLine& status) : scenario_(scenario), status_(status) {}

  /// References stay.
  const RestRun& run(const std::string& rotations, double theta_deg);

  /// The run with the misfit criterion that has the most rotation tets but not more than `count`. Looks for
  /// its threshold by bisection of its logarithm, between the runs that there are. Throws std::runtime_error
  /// if none comes to rest.
  const RestRun& most_tets_up_to(uint32_t count);

  [[nodiscard]] const std::deque<RestRun>& all() const { return runs_; }

 private:
  [[nodiscard]] const RestRun* find(const std::string& rotations, double theta_deg) const;
  [[nodiscard]] const RestRun* best_up_to(uint32_t count) const;
  [[nodiscard]] std::optional<double> next_theta(uint32_t count) const;

  Scenario scenario_;
  StatusLine& status_;
  std::deque<RestRun> runs_;
};

/// A complete cuboid-bend in the workstation's profile, which has room for any number of rotation tets.
Scenario bar_scenario(double bend_deg, double twist_deg);

}  // namespace palpate::sim
