// The tick: ports in, cycle, ports out.
#include "palpate/firmware/scenario_image.hpp"
#include "palpate/ports/buttons.hpp"
#include "palpate/ports/encoders.hpp"
#include "palpate/ports/motors.hpp"
#include "palpate/ports/tick_timer.hpp"
#include "palpate/ports/watchdog.hpp"
#include "run.hpp"

namespace palpate::firmware {

RunStorage g_storage;

namespace {

void count_tick(Run& run) {
  ++run.ticks;
  if (port::tick_pending()) ++run.overruns;
  --run.ticks_to_hash;
  // The state stands still while the background hashes it, however long that takes.
  if (run.ticks_to_hash == 0 || run.ticks == kScenarioImage.row_count) {
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
  const std::array<int32_t, 3> counts = read_encoders();
  const firmware::Sensors sensors{counts, (read_buttons() & kGraspButton) != 0};
  firmware::cycle(run.state, sensors, run.actuators, run.timer);
  write_motors(run.actuators.motor_codes);
  set_amplifiers(run.actuators.amplifiers_enabled);
  toggle_amplifier_watchdog();
  run.timer.end_tick();
  firmware::count_tick(run);
}

}  // namespace palpate::port
