// Random messages of the wire protocol, and whether two are the same.
#pragma once

#include "palpate/link/messages.hpp"
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
  return message;
}

inline link::ActuatorsMessage random_actuators(Random& random) {
  link::ActuatorsMessage message{};
  message.tick = random_word(random);
  for (uint16_t& code : message.motor_codes) code = static_cast<uint16_t>(random.below(4096));
  for (bool& enabled : message.is_amplifier_enabled) enabled = random.below(2) == 1;
  message.watchdog_level = random.below(2) == 1;
  message.fault = static_cast<uint8_t>(random.below(256));
  message.flags = random_word(random);
  return message;
}

inline bool is_same(const link::SensorsMessage& a, const link::SensorsMessage& b) {
  return a.tick == b.tick && a.encoder_counts == b.encoder_counts && a.gimbal_adc == b.gimbal_adc &&
         a.buttons == b.buttons && a.emergency_stop_pressed == b.emergency_stop_pressed &&
         a.amplifier_fault == b.amplifier_fault;
}

inline bool is_same(const link::ActuatorsMessage& a, const link::ActuatorsMessage& b) {
  return a.tick == b.tick && a.motor_codes == b.motor_codes &&
         a.is_amplifier_enabled == b.is_amplifier_enabled && a.watchdog_level == b.watchdog_level &&
         a.fault == b.fault && a.flags == b.flags;
}

}  // namespace palpate::test
