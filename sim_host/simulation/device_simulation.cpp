// The firmware's cycle on this machine, its sensors fed from the scenario's script.
#include "scenario/grasp_script.hpp"
#include "simulation/cycle_reading.hpp"
#include "simulation/cycle_recorder.hpp"
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
    require_started<Profile>(firmware::start(*state_, cycle_model(scenario)));
    recorder_ = make_recorder(scenario_, *state_, false);
    watched_ = find_node(state_->core, scenario_, kNodeToleranceMm);
  }

  bool advance() override {
    const firmware::ScriptRow& row = rows_[state_->core.tick];
    const auto& counts = row.encoder_counts;
    const firmware::Sensors sensors{{counts[0], counts[1], counts[2]},
                                    (row.buttons & firmware::ScriptRow::kGraspButton) != 0};
    firmware::Actuators actuators{};
    firmware::cycle(*state_, sensors, actuators, clock_);
    if (recorder_) recorder_->note(sensors);
    was_button_pressed_ = was_button_pressed_ || sensors.grasp_button;
    was_grasping_ = was_grasping_ || state_->core.grasp.holds();
    return state_->fault == firmware::Fault::kNone && state_->core.tick < rows_.size();
  }
  void end() override {
    if (recorder_) recorder_->end();
  }
  [[nodiscard]] Sample sample() const override { return cycle_sample(*state_, scenario_.model, watched_); }
  [[nodiscard]] uint32_t expected_ticks() const override { return static_cast<uint32_t>(rows_.size()); }
  [[nodiscard]] bool has_device() const override { return true; }
  [[nodiscard]] std::vector<double> stage_ms() const override { return clock_.milliseconds(); }
  [[nodiscard]] Totals totals() const override { return read_totals(state_->core); }
  [[nodiscard]] BodyShape shape() const override { return read_shape(state_->core, scenario_.model); }
  [[nodiscard]] BodyFields fields() const override { return read_fields(state_->core, scenario_.model); }

  [[nodiscard]] std::vector<std::string> hash_names() const override { return cycle_hash_names(); }
  [[nodiscard]] std::vector<uint64_t> hashes() const override { return cycle_hashes(*state_); }
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
  std::unique_ptr<CycleRecorder<Profile>> recorder_;
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
