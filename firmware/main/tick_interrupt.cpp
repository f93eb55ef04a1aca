// The tick: ports in, cycle, ports out.
#include "palpate/firmware/scenario_image.hpp"
#include "palpate/ports/buttons.hpp"
#include "palpate/ports/encoders.hpp"
#include "palpate/ports/motors.hpp"
#include "palpate/ports/tick_timer.hpp"
#include "palpate/ports/watchdog.hpp"
#include "run.hpp"

namespace palpate::firmware {

Run g_run;

namespace {

void count_tick() {
  ++g_run.ticks;
  if (port::tick_pending()) ++g_run.overruns;
  --g_run.ticks_to_hash;
  // The state stands still while the background hashes it, however long that takes.
  if (g_run.ticks_to_hash == 0 || g_run.ticks == kScenarioImage.row_count) {
    port::hold_ticks();
    g_run.ticks_to_hash = kHashEvery;
    g_run.held = true;
  }
}

}  // namespace
}  // namespace palpate::firmware

namespace palpate::port {

void on_tick() {
  firmware::Run& run = firmware::g_run;
  run.timer.begin_tick();
  const std::array<int32_t, 3> counts = read_encoders();
  const firmware::Sensors sensors{counts, (read_buttons() & kGraspButton) != 0};
  firmware::cycle(run.state, sensors, run.actuators, run.timer);
  write_motors(run.actuators.motor_codes);
  set_amplifiers(run.actuators.amplifiers_enabled);
  toggle_amplifier_watchdog();
  run.timer.end_tick();
  firmware::count_tick();
}

}  // namespace palpate::port
