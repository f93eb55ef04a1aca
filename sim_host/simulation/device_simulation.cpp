// The firmware's cycle on this machine, its sensors fed from the scenario's script.
#include "palpate/firmware/cycle.hpp"
#include "scenario/grasp_script.hpp"
#include "simulation/body_reading.hpp"
#include "simulation/read_fields.hpp"
#include "simulation/stage_clock.hpp"
#include "simulation/with_profile.hpp"

namespace palpate::sim {
namespace {

template <class Profile>
class DeviceSimulation final : public Simulation {
 public:
  explicit DeviceSimulation(const Scenario& scenario)
      : scenario_(scenario),
        rows_(grasp_script(scenario)),
        state_(std::make_unique<firmware::CycleState<Profile>>()) {
    const firmware::CycleModel model{compile_model(scenario.model),
                                     compile_scene(scenario.grasp.scene, scenario.model)};
    require_started<Profile>(firmware::start(*state_, model));
    watched_ = find_node(state_->core, scenario_, kNodeToleranceMm);
  }

  bool advance() override {
    const firmware::ScriptRow& row = rows_[state_->core.tick];
    const auto& counts = row.encoder_counts;
    const firmware::Sensors sensors{{counts[0], counts[1], counts[2]},
                                    (row.buttons & firmware::ScriptRow::kGraspButton) != 0};
    firmware::Actuators actuators{};
    firmware::cycle(*state_, sensors, actuators, clock_);
    was_button_pressed_ = was_button_pressed_ || sensors.grasp_button;
    was_grasping_ = was_grasping_ || state_->core.grasp.holds();
    return state_->fault == firmware::Fault::kNone && state_->core.tick < rows_.size();
  }
  [[nodiscard]] Sample sample() const override {
    const ModelParameters& model = scenario_.model;
    return Sample{state_->core.tick,
                  to_mm(state_->input.tool, model),
                  displacement_mm(state_->core, watched_, model.edge_m),
                  to_doubles(state_->force),
                  state_->motor_codes,
                  state_->output.flags,
                  state_->core.forest.leaf_count,
                  state_->core.front.groups.used()};
  }
  [[nodiscard]] uint32_t expected_ticks() const override { return static_cast<uint32_t>(rows_.size()); }
  [[nodiscard]] bool has_device() const override { return true; }
  [[nodiscard]] std::vector<double> stage_ms() const override { return clock_.milliseconds(); }
  [[nodiscard]] Totals totals() const override { return read_totals(state_->core); }
  [[nodiscard]] BodyShape shape() const override { return read_shape(state_->core, scenario_.model); }
  [[nodiscard]] BodyFields fields() const override { return read_fields(state_->core, scenario_.model); }

  [[nodiscard]] std::vector<std::string> hash_names() const override {
    std::vector<std::string> names;
    for (uint32_t i = 0; i < firmware::kStageCount; ++i) {
      names.emplace_back(firmware::stage_name(static_cast<firmware::Stage>(i)));
    }
    names.emplace_back("state");
    return names;
  }
  [[nodiscard]] std::vector<uint64_t> hashes() const override {
    std::vector<uint64_t> values;
    for (uint32_t i = 0; i < firmware::kStageCount; ++i) {
      values.push_back(firmware::stage_hash(*state_, static_cast<firmware::Stage>(i)));
    }
    values.push_back(firmware::state_hash(*state_));
    return values;
  }
  [[nodiscard]] std::optional<std::string> failure() const override {
    if (was_button_pressed_ && !was_grasping_) {
      return fmt::format("nothing was grasped: no node was within {:g} mm of the tool (grasp_reach_m)",
                         scenario_.model.grasp_reach_m * 1e3);
    }
    if (state_->fault == firmware::Fault::kNone) return std::nullopt;
    return fmt::format("the cycle stopped with fault {} after {} ticks", static_cast<int>(state_->fault),
                       state_->core.tick);
  }

 private:
  Scenario scenario_;
  std::vector<firmware::ScriptRow> rows_;
  std::unique_ptr<firmware::CycleState<Profile>> state_;
  StageClock<firmware::Stage, firmware::kStageCount> clock_;
  uint16_t watched_;
  bool was_button_pressed_ = false;
  bool was_grasping_ = false;
};

}  // namespace

std::unique_ptr<Simulation> make_device_simulation(const Scenario& scenario) {
  return with_profile(scenario.profile, [&](auto profile) -> std::unique_ptr<Simulation> {
    return std::make_unique<DeviceSimulation<decltype(profile)>>(scenario);
  });
}

}  // namespace palpate::sim
