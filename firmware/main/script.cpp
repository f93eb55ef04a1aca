// The firmware of a script: builds the mesh, lets the ticks play the script, and prints what came out.
#include "background.hpp"
#include "console_report.hpp"
#include "palpate/firmware/scenario_image.hpp"
#include "palpate/ports/system.hpp"
#include "palpate/ports/tick_timer.hpp"
#include "text.hpp"

namespace palpate::firmware {
namespace {

/// False when something that must always hold does not.
[[nodiscard]] bool run_script(Run& run) {
  run.last_tick = kScenarioImage.row_count;
  print_stage_names();
  port::start_ticks(kTickPeriodUs);
  for (;;) {
    port::wait_for_tick();
    if (!run.held) continue;
    if (!answer_hold(run).is_whole()) return false;
    if (run.ticks == run.last_tick) return true;
  }
}

[[noreturn]] void run_image() {
  Run& run = begin_run();
  const Status status = start(run.state, kScenarioImage.model);
  if (status != Status::kDone) {
    print("error,the model is refused with status ");
    print_decimal(static_cast<uint32_t>(status));
    print("\n");
    give_up();
  }
  const bool is_whole = run_script(run);
  end_run(run, kScenarioImage.name, is_whole);
}

}  // namespace
}  // namespace palpate::firmware

void palpate::port::run_firmware() { firmware::run_image(); }
