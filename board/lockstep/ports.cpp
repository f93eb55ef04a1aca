// The ports of the device: read from the message of the sensors, written to that of the actuators.
#include "exchange.hpp"
#include "palpate/ports/buttons.hpp"
#include "palpate/ports/device_status.hpp"
#include "palpate/ports/encoders.hpp"
#include "palpate/ports/gimbal.hpp"
#include "palpate/ports/indicator.hpp"
#include "palpate/ports/motors.hpp"
#include "palpate/ports/watchdog.hpp"

namespace palpate::port {

using lockstep::g_exchange;

std::array<int32_t, 3> read_encoders() { return g_exchange.sensors.encoder_counts; }

uint32_t encoder_reading_number() { return g_exchange.sensors.tick; }

std::array<uint32_t, 3> read_gimbal() {
  const std::array<uint16_t, 3>& codes = g_exchange.sensors.gimbal_adc;
  return {codes[0], codes[1], codes[2]};
}

uint32_t read_buttons() { return g_exchange.sensors.buttons; }

uint32_t read_device_status() {
  const link::SensorsMessage& sensors = g_exchange.sensors;
  return (sensors.emergency_stop_pressed ? kEmergencyStop : 0) |
         (sensors.amplifier_fault ? kAmplifierFault : 0) | (sensors.amplifiers_cut ? kAmplifiersCut : 0);
}

bool was_reset_by_watchdog() { return false; }

// One by one: to copy half-words together the compiler calls memcpy, whose time has no bound.
void write_motors(const std::array<uint16_t, 3>& codes) {
  g_exchange.actuators.motor_codes = {codes[0], codes[1], codes[2]};
}

void set_amplifiers(bool enabled) { g_exchange.actuators.is_amplifier_enabled = {enabled, enabled, enabled}; }

void feed_watchdogs() { g_exchange.actuators.watchdog_level = !g_exchange.actuators.watchdog_level; }

void start_watchdog() {}

void show(const Indication& indication) {
  g_exchange.actuators.safety_state = indication.safety_state;
  g_exchange.actuators.fault = indication.fault;
  g_exchange.actuators.conditions = indication.conditions;
  g_exchange.actuators.flags = indication.flags;
}

}  // namespace palpate::port
