#include "background.hpp"

#include <new>

#include "console_report.hpp"
#include "palpate/ports/motors.hpp"
#include "palpate/ports/system.hpp"
#include "palpate/ports/tick_timer.hpp"
#include "text.hpp"

namespace palpate::firmware {
namespace {

[[noreturn]] void finish(int status) {
  port::write_motors(at_rest().motor_codes);
  port::set_amplifiers(false);
  print("end\n");
  port::exit_program(status);
}

}  // namespace

Run& begin_run() {
  port::initialize_board();
  new (&g_storage.run) Run{};  // placed, not allocated
  the_run().ticks_to_hash = kHashEvery;
  return the_run();
}

Integrity answer_hold(Run& run) {
  print_hash_row(run);
  const Integrity integrity = check_integrity(run.state);
  if (!integrity.is_whole()) print_broken(run.ticks, integrity);
  run.held = false;
  if (run.ticks != run.last_tick) port::resume_ticks();
  return integrity;
}

[[noreturn]] void end_run(const Run& run, const char* scenario, bool is_whole) {
  print_pools(run);
  print_summary(run, scenario);
  finish(is_whole ? 0 : 1);
}

[[noreturn]] void give_up() { finish(1); }

}  // namespace palpate::firmware
