#include "loop.hpp"

#include <stdexcept>

#include "hil/closed_loop.hpp"
#include "hil/host_controller.hpp"
#include "plant/units.hpp"

namespace palpate::fault {

Loop::Loop(const plant::Hand& usual_hand, const safety::Parameters& parameters)
    : plant({}, usual_hand), usual_hand_(usual_hand), parameters_(parameters) {
  start_firmware();
}

void Loop::start_firmware() {
  static const firmware::CycleModel model = body_model();
  const bool is_started = firmware::start(cycle, model) == Status::kDone;
  if (!is_started || !firmware::guard_device(cycle, parameters_)) {
    throw std::logic_error("the device of the fault tests does not start");
  }
  was_late = false;
}

void Loop::lead_hand(const std::vector<plant::Knot>& way) {
  std::vector<plant::Knot> knots = {{plant.seconds(), plant.truth().tip}};
  for (plant::Knot knot : way) {
    knot.time += plant.seconds();
    knots.push_back(knot);
  }
  plant.hand_over(hand_with(std::move(knots)));
}

bool Loop::is_at_reset_pose() const {
  return plant.truth().arm.q.cwiseAbs().maxCoeff() < plant::radians(0.5);
}

bool Loop::has_torque() const {
  return given.amplifiers_enabled || given.motor_codes != firmware::at_rest().motor_codes;
}

void Loop::look() {
  ++timer;
  ++reading;
  const safety::EventSet requests = sim::next_request(state(), is_at_reset_pose());
  now = TickCase{telemetry::sensors_of(sim::sensors_message(plant.output()), requests)};
  now.sensors.report.timing = {timer, reading, was_late};
}

/// The watchdogs are fed by a cycle that ended in time, and by nothing else.
void Loop::compute() {
  firmware::NoProbe probe;
  firmware::cycle(cycle, now.sensors, given, probe);
  was_late = now.is_late;
  const bool is_edge = !now.is_late && !now.loses_edge;
  if (is_edge) line_level = !line_level;
  ticks_unfed = is_edge ? 0 : ticks_unfed + 1;
  const bool on = given.amplifiers_enabled;
  plant.step({given.motor_codes, {on, on, on}, line_level});
}

}  // namespace palpate::fault
