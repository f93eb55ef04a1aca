// A simulated device and a firmware, a tick at a time. The plant alone sets time.
//
// In a tick the firmware answers what the sensors showed at its start, and its answer holds until its end:
// a loop without a tick of delay but the hold. `extra_delay` ticks more show what a slower link does.
#pragma once

#include <deque>
#include <vector>

#include "hil/controller.hpp"
#include "palpate/safety/state.hpp"
#include "plant/plant.hpp"

namespace palpate::sim {

/// What the plant's sensors show, as the firmware gets it.
link::SensorsMessage sensors_message(const plant::PlantOutput& output);

/// What a user at the device asks for next on the way to force. Only at the reset pose is a calibration done.
safety::EventSet next_request(safety::State state, bool is_at_reset_pose);

/// In which tick of the plant a setting is to change; the first is 1.
struct PlannedChange {
  uint32_t tick;
  firmware::SettingChange change;
};

class ClosedLoop {
 public:
  ClosedLoop(plant::Plant& plant, Controller& controller, uint32_t extra_delay = 0);

  /// One a tick, in order.
  void plan(std::vector<PlannedChange> changes) { changes_.assign(changes.begin(), changes.end()); }
  void advance();

  [[nodiscard]] const plant::Plant& plant() const { return plant_; }
  /// Of the last tick.
  [[nodiscard]] const link::SensorsMessage& sensors() const { return sensors_; }
  [[nodiscard]] const UserWish& wish() const { return wish_; }
  [[nodiscard]] const link::ActuatorsMessage& answer() const { return answer_; }

 private:
  plant::Plant& plant_;
  Controller& controller_;
  link::SensorsMessage sensors_{};
  UserWish wish_;
  link::ActuatorsMessage answer_{};
  std::deque<plant::PlantInput> late_;  // answers on their way
  std::deque<PlannedChange> changes_;
};

}  // namespace palpate::sim
