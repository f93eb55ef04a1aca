// The firmware's cycle on this machine, with the simulated device around it.
#include "hil/plant_simulation.hpp"

#include <fmt/ranges.h>

#include "hil/host_controller.hpp"
#include "hil/setting_plan.hpp"
#include "hil/touch_task.hpp"
#include "simulation/cycle_simulation.hpp"
#include "simulation/with_profile.hpp"

namespace palpate::sim {
namespace {

std::string conditions_text(safety::ConditionSet conditions) {
  std::vector<std::string> names;
  for (uint32_t i = 0; i < safety::kConditionCount; ++i) {
    const auto condition = static_cast<safety::Condition>(i);
    if (conditions.has(condition)) names.emplace_back(safety::condition_name(condition));
  }
  return names.empty() ? "no condition" : fmt::format("{}", fmt::join(names, ", "));
}

template <class Profile>
class PlantSimulation final : public CycleSimulation<Profile> {
 public:
  PlantSimulation(const Scenario& scenario, std::function<void(const ClosedLoop&)> watch)
      : CycleSimulation<Profile>(scenario),
        watch_(std::move(watch)),
        plant_(touch_plant(scenario)),
        controller_(this->state(), this->clock()),
        loop_(plant_, controller_) {
    if (!firmware::guard_device(this->state(), safety::kPremium15Parameters)) {
      throw std::logic_error("the device's safety parameters are refused");
    }
    loop_.plan(planned_changes(scenario));
    this->begin_recording(true);
    controller_.on_cycle = [this](const firmware::Sensors& read) { this->note(read); };
  }

  bool advance() override {
    loop_.advance();
    watch_(loop_);
    return this->state().fault == firmware::Fault::kNone && this->state().core.tick < expected_ticks();
  }
  [[nodiscard]] uint32_t expected_ticks() const override { return touch_ticks(this->scenario()); }
  [[nodiscard]] std::optional<std::string> failure() const override {
    const safety::Safety& safety = this->state().safety;
    if (safety.state != safety::State::kFault) return std::nullopt;
    return fmt::format("the device ended in Fault: {}", conditions_text(safety.seen));
  }

 private:
  std::function<void(const ClosedLoop&)> watch_;
  plant::Plant plant_;
  HostController<Profile, typename CycleSimulation<Profile>::Clock> controller_;
  ClosedLoop loop_;
};

}  // namespace

std::unique_ptr<Simulation> make_plant_simulation(const Scenario& scenario,
                                                  std::function<void(const ClosedLoop&)> watch) {
  return with_profile(scenario.profile, [&](auto profile) -> std::unique_ptr<Simulation> {
    return std::make_unique<PlantSimulation<decltype(profile)>>(scenario, watch);
  });
}

}  // namespace palpate::sim
