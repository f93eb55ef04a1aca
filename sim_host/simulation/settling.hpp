// The end of a motion: from then on the body is damped heavily, until it is at rest.
#pragma once

#include <fmt/format.h>

#include "palpate/tick/state.hpp"
#include "simulation/rest_detector.hpp"
#include "simulation/simulation.hpp"

namespace palpate::sim {

template <class Profile>
class Settling {
 public:
  /// More than any bar of the paper's takes.
  static constexpr uint32_t kMostTicks = 30000;

  explicit Settling(const Scenario& scenario)
      : dynamics_(damped_dynamics(scenario)), rest_(limits_in_units(scenario.model)) {}

  /// Before the first tick of the rest.
  void begin(State<Profile>& state) const { state.model.dynamics = dynamics_; }
  /// After each of its ticks.
  void look(const State<Profile>& state) { rest_.look(state.forest, state.solve, state.driven.node); }
  [[nodiscard]] bool is_at_rest() const { return rest_.is_at_rest(); }

  [[nodiscard]] std::optional<std::string> failure(uint32_t ticks) const {
    if (is_at_rest()) return std::nullopt;
    return fmt::format(
        "the bar did not come to rest within {} ticks; allow more ticks or more settle_damping_per_s", ticks);
  }

 private:
  static Dynamics damped_dynamics(const Scenario& scenario) {
    ModelParameters damped = scenario.model;
    damped.mass_damping_per_s = scenario.settle_damping_per_s;
    return compile_model(damped).dynamics;
  }
  static RestLimits limits_in_units(const ModelParameters& model) {
    constexpr double kStillM = 0.1e-6;
    constexpr double kBalancedN = 0.005e-3;
    return RestLimits{kStillM / model.edge_m, kBalancedN / newtons_per_unit(model)};
  }

  Dynamics dynamics_;
  RestDetector<Profile> rest_;
};

}  // namespace palpate::sim
