// The firmware: builds the mesh, lets the tick interrupt run the script, and prints what came out.
#include "palpate/firmware/scenario_image.hpp"
#include "palpate/ports/motors.hpp"
#include "palpate/ports/system.hpp"
#include "palpate/ports/tick_timer.hpp"
#include "run.hpp"
#include "telemetry.hpp"
#include "text.hpp"

namespace palpate::firmware {
namespace {

[[noreturn]] void finish(int status) {
  port::set_amplifiers(false);
  print("end\n");
  port::exit_program(status);
}

void run_script() {
  g_run.ticks_to_hash = kHashEvery;
  print_stage_names();
  port::start_ticks(kTickPeriodUs);
  for (;;) {
    port::wait_for_tick();
    if (!g_run.held) continue;
    print_hash_row(g_run);
    if (g_run.ticks == kScenarioImage.row_count) return;
    g_run.held = false;
    port::resume_ticks();
  }
}

}  // namespace
}  // namespace palpate::firmware

namespace palpate::port {

void run_firmware() {
  using namespace firmware;
  initialize_board();
  const Status status = start(g_run.state, kScenarioImage.model);
  if (status != Status::kDone) {
    print("error,the model is refused with status ");
    print_decimal(static_cast<uint32_t>(status));
    print("\n");
    finish(1);
  }
  run_script();
  print_summary(g_run);
  finish(0);
}

}  // namespace palpate::port
