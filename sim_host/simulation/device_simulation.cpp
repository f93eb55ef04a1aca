// The firmware's cycle on this machine, its sensors fed from the scenario's script.
#include "scenario/grasp_script.hpp"
#include "simulation/cycle_simulation.hpp"
#include "simulation/with_profile.hpp"

namespace palpate::sim {
namespace {

template <class Profile>
class DeviceSimulation final : public CycleSimulation<Profile> {
 public:
  explicit DeviceSimulation(const Scenario& scenario)
      : CycleSimulation<Profile>(scenario), rows_(grasp_script(scenario)) {
    this->begin_recording(false);
  }

  bool advance() override {
    firmware::CycleState<Profile>& state = this->state();
    const firmware::ScriptRow& row = rows_[state.core.tick];
    const auto& counts = row.encoder_counts;
    const firmware::Sensors sensors{{counts[0], counts[1], counts[2]},
                                    (row.buttons & firmware::ScriptRow::kGraspButton) != 0};
    firmware::Actuators actuators{};
    firmware::cycle(state, sensors, actuators, this->clock());
    this->note(sensors);
    was_button_pressed_ = was_button_pressed_ || sensors.grasp_button;
    was_grasping_ = was_grasping_ || state.core.grasp.holds();
    return state.fault == firmware::Fault::kNone && state.core.tick < rows_.size();
  }
  [[nodiscard]] uint32_t expected_ticks() const override { return static_cast<uint32_t>(rows_.size()); }
  [[nodiscard]] std::optional<std::string> failure() const override {
    if (was_button_pressed_ && !was_grasping_) {
      return fmt::format("nothing was grasped: no node was within {:g} mm of the tool (grasp_reach_m)",
                         this->scenario().model.grasp_reach_m * 1e3);
    }
    if (this->state().fault == firmware::Fault::kNone) return std::nullopt;
    return fmt::format("the cycle stopped with fault {} after {} ticks",
                       static_cast<int>(this->state().fault), this->state().core.tick);
  }

 private:
  std::vector<firmware::ScriptRow> rows_;
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
