// Random messages of the wire protocol, and whether two are the same.
#pragma once

#include "palpate/link/telemetry_messages.hpp"
#include "support/random.hpp"

namespace palpate::test {

/// Any 32 bits, or a small number of either sign.
inline uint32_t random_word(Random& random) {
  const auto word = static_cast<uint32_t>(random.bits());
  return random.below(2) == 0 ? word : word % 512u - 256u;
}

inline link::SensorsMessage random_sensors(Random& random) {
  link::SensorsMessage message{};
  message.tick = random_word(random);
  for (int32_t& counts : message.encoder_counts) counts = static_cast<int32_t>(random_word(random));
  for (uint16_t& code : message.gimbal_adc) code = static_cast<uint16_t>(random_word(random));
  message.buttons = static_cast<uint8_t>(random.below(256));
  message.emergency_stop_pressed = random.below(2) == 1;
  message.amplifier_fault = random.below(2) == 1;
  message.amplifiers_cut = random.below(2) == 1;
  return message;
}

inline link::ActuatorsMessage random_actuators(Random& random) {
  link::ActuatorsMessage message{};
  message.tick = random_word(random);
  for (uint16_t& code : message.motor_codes) code = static_cast<uint16_t>(random.below(4096));
  for (bool& enabled : message.is_amplifier_enabled) enabled = random.below(2) == 1;
  message.watchdog_level = random.below(2) == 1;
  message.fault = static_cast<uint8_t>(random.below(256));
  message.safety_state = static_cast<uint8_t>(random.below(256));
  message.conditions = static_cast<uint16_t>(random_word(random));
  message.flags = random_word(random);
  return message;
}

inline uint16_t random_half(Random& random) { return static_cast<uint16_t>(random_word(random)); }
inline int16_t random_signed_half(Random& random) { return static_cast<int16_t>(random_word(random)); }

inline link::CommandMessage random_command(Random& random) {
  link::CommandMessage message{};
  message.requests = static_cast<uint32_t>(random.bits()) & link::kRequestBits;
  message.setting = random.below(2) == 0 ? uint16_t{0} : random_half(random);
  if (message.setting != 0) message.value = static_cast<int32_t>(random_word(random));
  message.ends_run = random.below(2) == 1;
  return message;
}

inline link::TelemetryMessage random_telemetry(Random& random) {
  link::TelemetryMessage message{};
  message.tick = random_word(random);
  message.state = static_cast<uint8_t>(random.below(8));
  message.fault = static_cast<uint8_t>(random.below(256));
  message.raised = random_half(random);
  for (int16_t& one : message.tool_20_um) one = random_signed_half(random);
  for (int16_t& one : message.force_mn) one = random_signed_half(random);
  message.flags = random_word(random);
  return message;
}

inline link::StageCyclesMessage random_stage_cycles(Random& random) {
  link::StageCyclesMessage message{};
  message.tick = random_word(random);
  message.part = static_cast<uint8_t>(random.below(2));
  for (uint32_t& cycles : message.cycles) cycles = random_word(random);
  return message;
}

inline link::CountersMessage random_counters(Random& random) {
  link::CountersMessage message{};
  for (uint32_t* one : {&message.tick, &message.dropped_records, &message.overruns, &message.rejected_frames,
                        &message.lost_frames, &message.discarded_bytes}) {
    *one = random_word(random);
  }
  return message;
}

inline link::MotorsMessage random_motors(Random& random) {
  link::MotorsMessage message{};
  message.tick = random_word(random);
  for (uint16_t& code : message.codes) code = static_cast<uint16_t>(random.below(4096));
  message.amplifiers_enabled = random.below(2) == 1;
  for (int16_t& one : message.winding_centi_celsius) one = random_signed_half(random);
  for (uint16_t& one : message.limit_ma) one = random_half(random);
  return message;
}

inline link::InputsMessage random_inputs(Random& random) {
  link::InputsMessage message{};
  for (uint32_t* one : {&message.tick, &message.message_number, &message.findings})
    *one = random_word(random);
  message.requests = static_cast<uint32_t>(random.bits()) & link::kRequestBits;
  message.is_late = random.below(2) == 1;
  if (random.below(2) == 0) return message;
  message.is_refused = random.below(2) == 1;
  message.setting = static_cast<uint16_t>(1 + random.below(65535));
  message.value = static_cast<int32_t>(random_word(random));
  return message;
}

inline bool is_same(const link::InputsMessage& a, const link::InputsMessage& b) {
  return a.tick == b.tick && a.message_number == b.message_number && a.requests == b.requests &&
         a.findings == b.findings && a.is_late == b.is_late && a.is_refused == b.is_refused &&
         a.setting == b.setting && a.value == b.value;
}

inline bool is_same(const link::CommandMessage& a, const link::CommandMessage& b) {
  return a.requests == b.requests && a.setting == b.setting && a.value == b.value && a.ends_run == b.ends_run;
}

inline bool is_same(const link::TelemetryMessage& a, const link::TelemetryMessage& b) {
  return a.tick == b.tick && a.state == b.state && a.fault == b.fault && a.raised == b.raised &&
         a.tool_20_um == b.tool_20_um && a.force_mn == b.force_mn && a.flags == b.flags;
}

inline bool is_same(const link::StageCyclesMessage& a, const link::StageCyclesMessage& b) {
  return a.tick == b.tick && a.part == b.part && a.cycles == b.cycles;
}

inline bool is_same(const link::CountersMessage& a, const link::CountersMessage& b) {
  return a.tick == b.tick && a.dropped_records == b.dropped_records && a.overruns == b.overruns &&
         a.rejected_frames == b.rejected_frames && a.lost_frames == b.lost_frames &&
         a.discarded_bytes == b.discarded_bytes;
}

inline bool is_same(const link::MotorsMessage& a, const link::MotorsMessage& b) {
  return a.tick == b.tick && a.codes == b.codes && a.amplifiers_enabled == b.amplifiers_enabled &&
         a.winding_centi_celsius == b.winding_centi_celsius && a.limit_ma == b.limit_ma;
}

inline bool is_same(const link::SensorsMessage& a, const link::SensorsMessage& b) {
  return a.tick == b.tick && a.encoder_counts == b.encoder_counts && a.gimbal_adc == b.gimbal_adc &&
         a.buttons == b.buttons && a.emergency_stop_pressed == b.emergency_stop_pressed &&
         a.amplifier_fault == b.amplifier_fault && a.amplifiers_cut == b.amplifiers_cut;
}

inline bool is_same(const link::ActuatorsMessage& a, const link::ActuatorsMessage& b) {
  return a.tick == b.tick && a.motor_codes == b.motor_codes &&
         a.is_amplifier_enabled == b.is_amplifier_enabled && a.watchdog_level == b.watchdog_level &&
         a.fault == b.fault && a.safety_state == b.safety_state && a.conditions == b.conditions &&
         a.flags == b.flags;
}

}  // namespace palpate::test
