// The scenarios in which the tool or the held ends are moved directly, without a device.
#include "palpate/tick/hash.hpp"
#include "simulation/arc.hpp"
#include "simulation/body_reading.hpp"
#include "simulation/read_fields.hpp"
#include "simulation/settling.hpp"
#include "simulation/stage_clock.hpp"
#include "simulation/with_profile.hpp"

namespace palpate::sim {
namespace {

constexpr double kPi = 3.14159265358979323846;
HoldMotions still_holds() { return {RigidMotion::identity(), RigidMotion::identity()}; }

template <class Profile>
class ToolSimulation : public Simulation {
 public:
  explicit ToolSimulation(const Scenario& scenario)
      : scenario_(scenario), state_(std::make_unique<State<Profile>>()) {
    require_started<Profile>(start(*state_, compile_model(scenario.model)));
    input_ = TickInput{zero_vector<Position>(), false, still_holds()};
    // A bend only watches the node, so any will do on a coarse mesh.
    constexpr double kAnywhereMm = 1e3;
    watched_ =
        find_node(*state_, scenario_, scenario.kind == ScenarioKind::kBend ? kAnywhereMm : kNodeToleranceMm);
  }

  [[nodiscard]] Sample sample() const override {
    const ModelParameters& model = scenario_.model;
    return Sample{state_->tick,
                  to_mm(input_.tool, model),
                  displacement_mm(*state_, watched_, model.edge_m),
                  scaled(force_in_units(), newtons_per_unit(model)),
                  {},
                  output_.flags,
                  state_->forest.leaf_count,
                  state_->front.groups.used()};
  }
  [[nodiscard]] bool has_device() const override { return false; }
  [[nodiscard]] std::vector<double> stage_ms() const override { return clock_.milliseconds(); }
  [[nodiscard]] Totals totals() const override { return read_totals(*state_); }
  [[nodiscard]] BodyShape shape() const override { return read_shape(*state_, scenario_.model); }
  [[nodiscard]] BodyFields fields() const override { return read_fields(*state_, scenario_.model); }

  [[nodiscard]] std::vector<std::string> hash_names() const override {
    std::vector<std::string> names;
    for (uint32_t i = 0; i < kCoreStages; ++i) names.emplace_back(stage_name(static_cast<CoreStage>(i)));
    names.emplace_back("state");
    return names;
  }
  [[nodiscard]] std::vector<uint64_t> hashes() const override {
    std::vector<uint64_t> values;
    for (uint32_t i = 0; i < kCoreStages; ++i) {
      values.push_back(stage_hash(*state_, output_, static_cast<CoreStage>(i)));
    }
    values.push_back(state_hash(*state_, output_));
    return values;
  }

 protected:
  [[nodiscard]] virtual std::array<double, 3> force_in_units() const { return to_doubles(output_.reaction); }
  [[nodiscard]] const Scenario& scenario() const { return scenario_; }
  [[nodiscard]] State<Profile>& state() { return *state_; }
  [[nodiscard]] const State<Profile>& state() const { return *state_; }
  [[nodiscard]] uint16_t watched() const { return watched_; }

  void tick_with(const TickInput& input) {
    input_ = input;
    tick(*state_, input_, output_, clock_);
  }
  [[nodiscard]] uint32_t ticks_or(uint32_t all) const {
    return scenario_.ticks == Scenario::kAllTicks ? all : static_cast<uint32_t>(scenario_.ticks);
  }

 private:
  Scenario scenario_;
  std::unique_ptr<State<Profile>> state_;
  TickInput input_;
  TickOutput output_{zero_vector<Force>(), 0};
  StageClock<CoreStage, kCoreStages> clock_;
  uint16_t watched_;
};

template <class Profile>
class SineSimulation final : public ToolSimulation<Profile> {
 public:
  explicit SineSimulation(const Scenario& scenario)
      : ToolSimulation<Profile>(scenario),
        settling_(scenario),
        period_(kPeriodTicks * static_cast<uint32_t>(scenario.sine.slow)) {
    if (this->state().solve.control[this->watched()] != NodeControl::kFree) {
      throw BadInput("the driven node is on a held face: choose another node_mm or hold");
    }
  }

  bool advance() override {
    State<Profile>& state = this->state();
    const bool rests = rests_at_peak() && state.tick >= period_ / 4;
    const uint32_t k = rests ? period_ / 4 : state.tick;
    if (rests && state.tick == k) settling_.begin(state);
    const double degrees = 0.072 * k / this->scenario().sine.slow;
    const double u_mm = this->scenario().sine.amplitude_mm * std::sin(degrees * kPi / 180.0);
    TickInput input{rest_position(state.forest.node.rest[this->watched()]), true, still_holds()};
    // k = 0 is at rest, so the grasp closes without an offset.
    input.tool[1] += to_fixed<Position>(u_mm * 1e-3 / this->scenario().model.edge_m);
    this->tick_with(input);
    if (rests) settling_.look(state);
    return !settling_.is_at_rest() && state.tick < expected_ticks();
  }
  [[nodiscard]] uint32_t expected_ticks() const override {
    return this->ticks_or(rests_at_peak() ? Settling<Profile>::kMostTicks : 2 * period_);
  }
  [[nodiscard]] std::optional<std::string> failure() const override {
    return rests_at_peak() ? settling_.failure(expected_ticks()) : std::nullopt;
  }

 private:
  static constexpr uint32_t kPeriodTicks = 5000;

  [[nodiscard]] bool rests_at_peak() const { return this->scenario().sine.rest_at_peak; }

  Settling<Profile> settling_;
  uint32_t period_;
};

template <class Profile>
class BendSimulation final : public ToolSimulation<Profile> {
 public:
  explicit BendSimulation(const Scenario& scenario)
      : ToolSimulation<Profile>(scenario), settling_(scenario) {}

  bool advance() override {
    State<Profile>& state = this->state();
    if (state.tick == kTurnTicks) settling_.begin(state);
    TickInput input{zero_vector<Position>(), false, still_holds()};
    input.hold_motion[1] = end_motion(this->scenario(), std::min(1.0, (state.tick + 1.0) / kTurnTicks));
    this->tick_with(input);
    if (state.tick > kTurnTicks) settling_.look(state);
    return !settling_.is_at_rest() && state.tick < expected_ticks();
  }
  [[nodiscard]] uint32_t expected_ticks() const override {
    return this->ticks_or(Settling<Profile>::kMostTicks);
  }
  [[nodiscard]] std::optional<std::string> failure() const override {
    return settling_.failure(expected_ticks());
  }

 private:
  static constexpr uint32_t kTurnTicks = 2000;

  /// Of the tissue on the turned end.
  [[nodiscard]] std::array<double, 3> force_in_units() const override {
    const State<Profile>& state = this->state();
    std::array<double, 3> sum{};
    for (uint32_t i = 0; i < state.forest.nodes.used(); ++i) {
      const uint16_t node = state.forest.nodes.live(i);
      if (state.solve.control[node] != NodeControl::kHeldBySecond) continue;
      const auto force = to_doubles(state.forest.node.force[node]);
      for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += force[axis];
    }
    return sum;
  }

  Settling<Profile> settling_;
};

}  // namespace

std::unique_ptr<Simulation> make_tool_simulation(const Scenario& scenario) {
  return with_profile(scenario.profile, [&](auto profile) -> std::unique_ptr<Simulation> {
    using Profile = decltype(profile);
    if (scenario.kind == ScenarioKind::kBend) return std::make_unique<BendSimulation<Profile>>(scenario);
    return std::make_unique<SineSimulation<Profile>>(scenario);
  });
}

}  // namespace palpate::sim
