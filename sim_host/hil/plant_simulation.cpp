// The firmware's cycle on this machine, with the simulated device around it.
#include <memory>

#include "hil/closed_loop.hpp"
#include "hil/host_controller.hpp"
#include "hil/plant_simulation.hpp"
#include "hil/touch_task.hpp"
#include "simulation/body_reading.hpp"
#include "simulation/cycle_reading.hpp"
#include "simulation/cycle_recorder.hpp"
#include "simulation/read_fields.hpp"
#include "simulation/stage_clock.hpp"
#include "simulation/with_profile.hpp"

namespace palpate::sim {
namespace {

template <class Profile>
class PlantSimulation final : public Simulation {
 public:
  PlantSimulation(const Scenario& scenario, std::function<void(const ClosedLoop&)> watch)
      : scenario_(scenario),
        watch_(std::move(watch)),
        state_(std::make_unique<firmware::CycleState<Profile>>()),
        plant_(touch_plant(scenario)),
        controller_(*state_, clock_),
        loop_(plant_, controller_) {
    require_started<Profile>(firmware::start(*state_, cycle_model(scenario)));
    if (!firmware::guard_device(*state_, safety::kPremium15Parameters)) {
      throw std::logic_error("the device's safety parameters are refused");
    }
    recorder_ = make_recorder(scenario_, *state_, true);
    if (recorder_) controller_.on_cycle = [this](const firmware::Sensors& read) { recorder_->note(read); };
    watched_ = find_node(state_->core, scenario_, kNodeToleranceMm);
  }

  bool advance() override {
    loop_.advance();
    watch_(loop_);
    return state_->fault == firmware::Fault::kNone && state_->core.tick < expected_ticks();
  }
  void end() override {
    if (recorder_) recorder_->end();
  }
  [[nodiscard]] Sample sample() const override { return cycle_sample(*state_, scenario_.model, watched_); }
  [[nodiscard]] uint32_t expected_ticks() const override { return touch_ticks(scenario_); }
  [[nodiscard]] bool has_device() const override { return true; }
  [[nodiscard]] std::vector<double> stage_ms() const override { return clock_.milliseconds(); }
  [[nodiscard]] Totals totals() const override { return read_totals(state_->core); }
  [[nodiscard]] BodyShape shape() const override { return read_shape(state_->core, scenario_.model); }
  [[nodiscard]] BodyFields fields() const override { return read_fields(state_->core, scenario_.model); }
  [[nodiscard]] std::vector<std::string> hash_names() const override { return cycle_hash_names(); }
  [[nodiscard]] std::vector<uint64_t> hashes() const override { return cycle_hashes(*state_); }
  [[nodiscard]] std::optional<std::string> failure() const override {
    if (state_->safety.state != safety::State::kFault) return std::nullopt;
    return fmt::format("the device ended in Fault: {}", conditions_text(state_->safety.seen));
  }

 private:
  Scenario scenario_;
  std::function<void(const ClosedLoop&)> watch_;
  std::unique_ptr<firmware::CycleState<Profile>> state_;
  std::unique_ptr<CycleRecorder<Profile>> recorder_;
  StageClock<firmware::Stage, firmware::kStageCount> clock_;
  plant::Plant plant_;
  HostController<Profile, StageClock<firmware::Stage, firmware::kStageCount>> controller_;
  ClosedLoop loop_;
  uint16_t watched_ = 0;
};

}  // namespace

std::unique_ptr<Simulation> make_plant_simulation(const Scenario& scenario,
                                                  std::function<void(const ClosedLoop&)> watch) {
  return with_profile(scenario.profile, [&](auto profile) -> std::unique_ptr<Simulation> {
    return std::make_unique<PlantSimulation<decltype(profile)>>(scenario, watch);
  });
}

}  // namespace palpate::sim
