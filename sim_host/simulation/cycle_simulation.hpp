// What simulations of the whole cycle share, whoever feeds its sensors: its state, its recording, and what
// can be read off it.
#pragma once

#include "palpate/firmware/cycle.hpp"
#include "simulation/body_reading.hpp"
#include "simulation/cycle_recorder.hpp"
#include "simulation/read_fields.hpp"
#include "simulation/simulation.hpp"
#include "simulation/stage_clock.hpp"

namespace palpate::sim {

template <class Profile>
class CycleSimulation : public Simulation {
 public:
  void end() final {
    if (recorder_) recorder_->end();
  }
  [[nodiscard]] Sample sample() const final {
    return Sample{state_->core.tick,
                  to_mm(state_->input.tool, scenario_.model),
                  displacement_mm(state_->core, watched_, scenario_.model.edge_m),
                  to_doubles(state_->force),
                  state_->motor_codes,
                  state_->output.flags,
                  state_->core.forest.leaf_count,
                  state_->core.front.groups.used()};
  }
  [[nodiscard]] bool has_device() const final { return true; }
  [[nodiscard]] std::vector<double> stage_ms() const final { return clock_.milliseconds(); }
  [[nodiscard]] Totals totals() const final { return read_totals(state_->core); }
  [[nodiscard]] BodyShape shape() const final { return read_shape(state_->core, scenario_.model); }
  [[nodiscard]] BodyFields fields() const final { return read_fields(state_->core, scenario_.model); }
  [[nodiscard]] std::vector<std::string> hash_names() const final {
    std::vector<std::string> names;
    for (uint32_t i = 0; i < firmware::kStageCount; ++i) {
      names.emplace_back(firmware::stage_name(static_cast<firmware::Stage>(i)));
    }
    names.emplace_back("state");
    return names;
  }
  [[nodiscard]] std::vector<uint64_t> hashes() const final {
    std::vector<uint64_t> values;
    for (uint32_t i = 0; i < firmware::kStageCount; ++i) {
      values.push_back(firmware::stage_hash(*state_, static_cast<firmware::Stage>(i)));
    }
    values.push_back(firmware::state_hash(*state_));
    return values;
  }

 protected:
  using Clock = StageClock<firmware::Stage, firmware::kStageCount>;

  /// Builds the mesh at rest.
  explicit CycleSimulation(const Scenario& scenario)
      : scenario_(scenario), state_(std::make_unique<firmware::CycleState<Profile>>()) {
    require_started<Profile>(firmware::start(*state_, cycle_model(scenario)));
    watched_ = find_node(state_->core, scenario_, kNodeToleranceMm);
  }

  /// Where the scenario asks for a recording. Once the state is guarded, if a hand holds the device.
  void begin_recording(bool is_guarded) { recorder_ = make_recorder(scenario_, *state_, is_guarded); }
  /// After each cycle, with what it was fed with.
  void note(const firmware::Sensors& sensors) {
    if (recorder_) recorder_->note(sensors);
  }

  const Scenario& scenario() const { return scenario_; }
  firmware::CycleState<Profile>& state() { return *state_; }
  const firmware::CycleState<Profile>& state() const { return *state_; }
  Clock& clock() { return clock_; }

 private:
  Scenario scenario_;
  std::unique_ptr<firmware::CycleState<Profile>> state_;
  std::unique_ptr<CycleRecorder<Profile>> recorder_;
  Clock clock_;
  uint16_t watched_ = 0;
};

}  // namespace palpate::sim
