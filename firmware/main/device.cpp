// The firmware of a device that a hand holds: takes the model from the board's memory, guards the device,
// obeys commands from the link and reports over it. It never moves a motor with a model that is not whole.
#include "background.hpp"
#include "console_report.hpp"
#include "link_service.hpp"
#include "palpate/firmware/model_container.hpp"
#include "palpate/ports/device_status.hpp"
#include "palpate/ports/model_memory.hpp"
#include "palpate/ports/system.hpp"
#include "palpate/ports/tick_timer.hpp"
#include "palpate/ports/watchdog.hpp"
#include "text.hpp"

namespace palpate::firmware {
namespace {

/// What lies behind the container in the memory is not the container's.
container::Finding read_from_memory(CycleModel& model) {
  const port::ModelMemory memory = port::model_memory();
  const container::Finding finding = read_model({memory.bytes, memory.size}, Profile::kMaxLevel, model);
  if (finding.status != container::ReadStatus::kBytesAfterEnd) return finding;
  return read_model({memory.bytes, finding.offset}, Profile::kMaxLevel, model);
}

void print_refusal(const char* what, uint32_t status, uint32_t place) {
  print("refused,");
  print(what);
  print(",");
  print_decimal(status);
  print(",");
  print_decimal(place);
  print("\n");
}

/// Without a model the cycle runs all the same, and says over the link that it stands still.
void load_model(Run& run) {
  CycleModel model{};
  const container::Finding finding = read_from_memory(model);
  if (!finding.is_done()) {
    print_refusal("container", static_cast<uint32_t>(finding.status), finding.offset);
    return refuse_model(run.state);
  }
  const Status status = start(run.state, model);
  if (status != Status::kDone) return print_refusal("model", static_cast<uint32_t>(status), 0);
  if (!guard_device(run.state, safety::kPremium15Parameters)) print_refusal("parameters", 0, 0);
}

[[noreturn]] void run_device() {
  Run& run = begin_run();
  load_model(run);
  if (port::was_reset_by_watchdog())
    leave(run.findings, safety::ConditionSet::of(safety::Condition::kWatchdog));
  print_stage_names();
  bool is_whole = true;
  LinkService link;
  port::start_watchdog();
  port::start_ticks(kTickPeriodUs);
  for (;;) {
    port::wait_for_tick();
    if (run.held && !answer_hold(run).is_whole()) {
      is_whole = false;
      leave(run.findings, safety::ConditionSet::of(safety::Condition::kInvariantBroken));
    }
    if (link.serve(run) != LinkRequest::kEnd) continue;
    port::hold_ticks();
    if (run.ticks_to_hash != kHashEvery) print_hash_row(run);  // else it is there
    end_run(run, "device", is_whole);
  }
}

}  // namespace
}  // namespace palpate::firmware

void palpate::port::run_firmware() { firmware::run_device(); }
