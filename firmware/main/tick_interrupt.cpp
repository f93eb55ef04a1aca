// The tick: ports in, cycle, ports out.
#include "palpate/ports/buttons.hpp"
#include "palpate/ports/device_status.hpp"
#include "palpate/ports/encoders.hpp"
#include "palpate/ports/gimbal.hpp"
#include "palpate/ports/indicator.hpp"
#include "palpate/ports/motors.hpp"
#include "palpate/ports/tick_timer.hpp"
#include "palpate/ports/watchdog.hpp"
#include "run.hpp"

namespace palpate::firmware {

RunStorage g_storage;

namespace {

safety::ConditionSet reported_by(uint32_t status) {
  using safety::Condition;
  using safety::ConditionSet;
  return ConditionSet::of(Condition::kEmergencyStop, (status & port::kEmergencyStop) != 0) |
         ConditionSet::of(Condition::kAmplifierFault, (status & port::kAmplifierFault) != 0) |
         ConditionSet::of(Condition::kWatchdog, (status & port::kAmplifiersCut) != 0);
}

Sensors read_sensors(Run& run) {
  const std::array<int32_t, 3> counts = port::read_encoders();
  const bool is_grasping = (port::read_buttons() & port::kGraspButton) != 0;
  const std::array<uint32_t, 3> gimbal = port::read_gimbal();
  DeviceReport report{};
  report.timing = {port::tick_number(), port::encoder_reading_number(), run.was_late};
  report.reported = reported_by(port::read_device_status()) | take(run.findings);
  report.requests = take(run.requests);
  report.change = take(run.changes);
  return {counts, is_grasping, gimbal, report};
}

void write_actuators(const Run& run) {
  port::write_motors(run.actuators.motor_codes);
  port::set_amplifiers(run.actuators.amplifiers_enabled);
  const safety::Safety& safety = run.state.safety;
  port::show({static_cast<uint8_t>(safety.state), static_cast<uint8_t>(run.state.fault),
              static_cast<uint16_t>(safety.raised.bits()), run.state.output.flags,
              run.actuators.amplifiers_enabled});
}

/// Nobody waits: what finds no place is counted.
void leave_telemetry(Run& run, const Sensors& sensors) {
  if (telemetry::TickRecord* const record = run.telemetry.claim()) {
    telemetry::fill_record(*record, sensors, run.state, run.timer.this_tick(), run.overruns);
    run.telemetry.publish();
  }
}

/// The watchdogs bite when this cycle was not in time.
void end_tick(Run& run) {
  run.timer.end_tick();
  run.was_late = port::tick_pending();
  if (run.was_late) {
    ++run.overruns;
  } else {
    port::feed_watchdogs();
  }
  ++run.ticks;
  --run.ticks_to_hash;
  // The state stands still while the background hashes it, however long that takes.
  if (run.ticks_to_hash == 0 || run.ticks == run.last_tick) {
    port::hold_ticks();
    run.ticks_to_hash = kHashEvery;
    run.held = true;
  }
}

}  // namespace
}  // namespace palpate::firmware

namespace palpate::port {

void on_tick() {
  firmware::Run& run = firmware::the_run();
  run.timer.begin_tick();
  const firmware::Sensors sensors = firmware::read_sensors(run);
  firmware::cycle(run.state, sensors, run.actuators, run.timer);
  firmware::write_actuators(run);
  firmware::leave_telemetry(run, sensors);
  firmware::end_tick(run);
}

}  // namespace palpate::port
