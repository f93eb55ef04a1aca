// Between a cycle and its row.
#pragma once

#include "palpate/firmware/cycle.hpp"
#include "recording/format.hpp"

namespace palpate::recording {

inline constexpr uint8_t kGraspButton = 1;

/// What a cycle is fed with again. The device's status is in it as what was reported.
inline firmware::Sensors sensors_of(const TickRow& row) {
  firmware::Sensors sensors{};
  sensors.encoder_counts = row.encoder_counts;
  sensors.grasp_button = (row.buttons & kGraspButton) != 0;
  for (std::size_t i = 0; i < 3; ++i) sensors.gimbal[i] = row.gimbal[i];
  sensors.report = {row.timing, row.reported, row.requests};
  return sensors;
}

/// What went into a cycle; what came out is not there yet.
inline TickRow row_of(const firmware::Sensors& sensors) {
  using safety::Condition;
  TickRow row{};
  row.encoder_counts = sensors.encoder_counts;
  row.timing = sensors.report.timing;
  row.requests = sensors.report.requests;
  row.reported = sensors.report.reported;
  for (std::size_t i = 0; i < 3; ++i) row.gimbal[i] = static_cast<uint16_t>(sensors.gimbal[i]);
  row.buttons = sensors.grasp_button ? kGraspButton : uint8_t{0};
  const auto bit = [&row](Condition condition, uint32_t place) {
    return (row.reported.has(condition) ? 1u : 0u) << place;
  };
  row.device_status = static_cast<uint8_t>(bit(Condition::kEmergencyStop, 0) |
                                           bit(Condition::kAmplifierFault, 1) | bit(Condition::kWatchdog, 2));
  return row;
}

/// After a cycle with these sensors.
template <class Profile>
TickRow row_of(const firmware::Sensors& sensors, const firmware::CycleState<Profile>& state) {
  TickRow row = row_of(sensors);
  row.motor_codes = state.motor_codes;
  row.raised = state.safety.raised;
  row.flags = state.output.flags;
  row.amplifiers_enabled = state.amplifiers_enabled;
  row.state = state.safety.state;
  row.fault = state.fault;
  return row;
}

template <class Profile>
HashPoint hashes_of(uint32_t tick, const firmware::CycleState<Profile>& state) {
  HashPoint point{tick, {}, firmware::state_hash(state)};
  for (uint32_t i = 0; i < firmware::kStageCount; ++i) {
    point.stages[i] = firmware::stage_hash(state, static_cast<firmware::Stage>(i));
  }
  return point;
}

}  // namespace palpate::recording
