// What a tick leaves for the telemetry: values as the cycle has them. To turn them into the wire's units is
// the background's work.
#pragma once

#include "palpate/firmware/cycle.hpp"
#include "palpate/telemetry/ring.hpp"

namespace palpate::telemetry {

struct TickRecord {
  firmware::Sensors sensors;  // what entered the tick

  // What came of it.
  uint32_t tick;
  uint32_t flags;     // TickFlag bits
  uint32_t overruns;  // since the start
  safety::ConditionSet raised;
  std::array<phantom::Metre, 3> tool;  // in the device's frame
  std::array<phantom::Newton, 3> force;
  std::array<safety::Celsius, 3> winding;
  std::array<safety::Ampere, 3> current_limit;
  std::array<uint32_t, firmware::kStageCount> stage_cycles;
  std::array<uint16_t, 3> motor_codes;
  safety::State state;
  firmware::Fault fault;
  bool amplifiers_enabled;
  bool is_setting_refused;
};

/// After the cycle. While the cycle stands still with a fault, tool and force are the last ones. Some 10
/// multiplies.
template <class Profile>
void fill_record(TickRecord& record, const firmware::Sensors& sensors,
                 const firmware::CycleState<Profile>& state,
                 const std::array<uint32_t, firmware::kStageCount>& stage_cycles, uint32_t overruns) {
  record.sensors = sensors;
  record.tick = state.core.tick;
  record.flags = state.output.flags;
  record.overruns = overruns;
  record.raised = state.safety.raised;
  const Vector3<phantom::Metre> tool = phantom::premium::tool_position(state.posture);
  for (const uint32_t i : bounded<3>(3, [] {})) {
    const auto axis = static_cast<Eigen::Index>(i);
    const safety::WarmMotor& motor = state.safety.motors.motors[i];
    record.tool[i] = tool[axis];
    record.force[i] = state.force[axis];
    record.winding[i] = safety::celsius(motor.temperatures.winding);
    record.current_limit[i] = motor.current_limit;
    record.motor_codes[i] = state.motor_codes[i];
  }
  for (const uint32_t i : bounded<firmware::kStageCount>(firmware::kStageCount, [] {})) {
    record.stage_cycles[i] = stage_cycles[i];
  }
  record.state = state.safety.state;
  record.fault = state.fault;
  record.amplifiers_enabled = state.amplifiers_enabled;
  record.is_setting_refused = state.is_setting_refused;
}

}  // namespace palpate::telemetry
