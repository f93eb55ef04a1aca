// A cycle's sensors as the wire's message, and back.
#pragma once

#include "palpate/firmware/sensors.hpp"
#include "palpate/link/messages.hpp"

namespace palpate::telemetry {

/// Numbered as the timer's tick. The message's own number, requests, changes, a late cycle and what others
/// than the device report are not in it.
inline link::SensorsMessage message_of(const firmware::Sensors& sensors) {
  using safety::Condition;
  const firmware::DeviceReport& report = sensors.report;
  return {report.timing.tick_number,
          sensors.encoder_counts,
          {static_cast<uint16_t>(sensors.gimbal[0]), static_cast<uint16_t>(sensors.gimbal[1]),
           static_cast<uint16_t>(sensors.gimbal[2])},
          sensors.grasp_button ? link::kGraspButton : uint8_t{0},
          report.reported.has(Condition::kEmergencyStop),
          report.reported.has(Condition::kAmplifierFault),
          report.reported.has(Condition::kWatchdog)};
}

/// Of a message that is a tick of its own, in time.
inline firmware::Sensors sensors_of(const link::SensorsMessage& message, safety::EventSet requests) {
  using safety::Condition;
  using safety::ConditionSet;
  firmware::DeviceReport report{};
  report.timing = {message.tick, message.tick, false};
  report.reported = ConditionSet::of(Condition::kEmergencyStop, message.emergency_stop_pressed) |
                    ConditionSet::of(Condition::kAmplifierFault, message.amplifier_fault) |
                    ConditionSet::of(Condition::kWatchdog, message.amplifiers_cut);
  report.requests = requests;
  const std::array<uint16_t, 3>& gimbal = message.gimbal_adc;
  return {message.encoder_counts,
          (message.buttons & link::kGraspButton) != 0,
          {gimbal[0], gimbal[1], gimbal[2]},
          report};
}

}  // namespace palpate::telemetry
