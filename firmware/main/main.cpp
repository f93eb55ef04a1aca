// The firmware: builds the mesh, lets the tick interrupt run the script, and prints what came out.
#include <new>

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
  constexpr auto kZeroCode = static_cast<uint16_t>(phantom::kZeroCode);
  port::write_motors({kZeroCode, kZeroCode, kZeroCode});
  port::set_amplifiers(false);
  print("end\n");
  port::exit_program(status);
}

/// False when something that must always hold does not.
[[nodiscard]] bool run_script(Run& run) {
  run.ticks_to_hash = kHashEvery;
  print_stage_names();
  port::start_ticks(kTickPeriodUs);
  for (;;) {
    port::wait_for_tick();
    if (!run.held) continue;
    print_hash_row(run);
    const Integrity integrity = check_integrity(run.state);
    if (!integrity.is_whole()) {
      print_broken(run.ticks, integrity);
      return false;
    }
    if (run.ticks == kScenarioImage.row_count) return true;
    run.held = false;
    port::resume_ticks();
  }
}

[[noreturn]] void run_image() {
  port::initialize_board();
  new (&g_storage.run) Run{};  // placed, not allocated
  Run& run = the_run();
  const Status status = start(run.state, kScenarioImage.model);
  if (status != Status::kDone) {
    print("error,the model is refused with status ");
    print_decimal(static_cast<uint32_t>(status));
    print("\n");
    finish(1);
  }
  const bool whole = run_script(run);
  print_pools(run);
  print_summary(run);
  finish(whole ? 0 : 1);
}

}  // namespace
}  // namespace palpate::firmware

void palpate::port::run_firmware() { firmware::run_image(); }
