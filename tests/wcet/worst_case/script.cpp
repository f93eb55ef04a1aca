// The program of the worst case: the firmware's tick, in states and with inputs that an adversary chose. Its
// name tells the linker script that it is the background's.
//
// On QEMU's command line "search FIRST COUNT" runs other seeds than the recorded ones.
#include "background.hpp"
#include "console_report.hpp"
#include "inputs.hpp"
#include "palpate/ports/buttons.hpp"
#include "palpate/ports/cycle_counter.hpp"
#include "palpate/ports/system.hpp"
#include "palpate/ports/tick_timer.hpp"
#include "seeds.hpp"
#include "semihosting.hpp"
#include "setup.hpp"
#include "storm_run.hpp"
#include "text.hpp"
#include "wild.hpp"

namespace palpate::worst_case {
namespace {

constexpr uint32_t kStorms = 6;
constexpr uint32_t kWilds = 900;
constexpr uint32_t kWildTicks = 2 * kScheduleTicks;  // so that the next one is the mesh's

void print_figure(const char* name, uint32_t value) {
  firmware::print(name);
  firmware::print_decimal(value);
}

void require_whole(firmware::Run& run, uint32_t seed, uint32_t tick) {
  const firmware::Integrity integrity = firmware::check_integrity(run.state);
  if (integrity.is_whole()) return;
  print_figure("seed,", seed);
  firmware::print("\n");
  firmware::print_broken(tick, integrity);
  firmware::give_up();
}

void run_tick(firmware::Run& run, uint32_t seed, uint32_t tick) {
  const uint32_t start = port::read_cycle_counter();
  port::on_tick();
  const uint32_t instructions = port::read_cycle_counter() - start;
  print_figure("tick,", seed);
  print_figure(",", tick);
  print_figure(",", instructions);
  print_figure(",leaves,", run.state.core.forest.leaf_count);
  print_figure(",nodes,", run.state.core.forest.nodes.used());
  print_figure(",groups,", run.state.core.front.groups.used());
  print_figure(",tethers,", run.state.core.tethers.count);
  firmware::print("\n");
  require_whole(run, seed, tick);
}

void set_up(firmware::Run& run, const Scene& scene) {
  g_inputs = {};
  const Status status = Setup(run, scene).build();
  if (status == Status::kDone) return require_whole(run, scene.seed, 0);
  print_figure("refused,", scene.seed);
  print_figure(",", static_cast<uint32_t>(status));
  firmware::print("\n");
  firmware::give_up();
}

/// For each tick of the schedule its worst one, and one that goes on with what it left.
void run_scene(firmware::Run& run, uint32_t seed) {
  for (uint32_t first = 0; first < kScheduleTicks; ++first) {
    Scene scene = draw_scene(seed);
    scene.slot = slot_of(first);
    set_up(run, scene);
    run.state.core.tick = first;
    for (uint32_t tick = first; tick < first + 2; ++tick) {
      ++g_inputs.reading_number;
      run_tick(run, seed, tick);
    }
  }
}

void run_wild(firmware::Run& run, uint32_t seed) {
  Scene scene = draw_scene(seed);
  scene.grows = seed % 4 == 0;
  if (seed % 8 == 0) scene.most_leaves = static_cast<uint16_t>(Profile::kLeaves / 2 + seed % 64);
  scene.is_crowded = seed % 5 == 0;
  scene.wishes_any = seed % 2 == 0;
  if (seed % 3 != 0) scene.most_groups = static_cast<uint16_t>(seed % Profile::kGroups);
  set_up(run, scene);
  if (seed % 16 == 1 && !guard_device(run.state, safety::kPremium15Parameters)) firmware::give_up();
  Wild wild(run, seed);
  for (uint32_t tick = 1; tick <= kWildTicks; ++tick) {
    ++g_inputs.reading_number;
    if (tick > 1) wild.shake();
    run_tick(run, seed, tick);
  }
  wild.take_nodes();
  port::on_tick();
  wild.give_back_nodes();
  require_whole(run, seed, kWildTicks + 1);
  wild.damage();
  port::on_tick();
  wild.repair();
  require_whole(run, seed, kWildTicks + 2);
}

/// What happens around a cycle: it is late, the run is to be held after it, and it stands still for good.
void run_odd_ticks(firmware::Run& run) {
  set_up(run, draw_scene(1));
  asm volatile("cpsid i" ::: "memory");  // nobody hears the timer
  port::start_ticks(1);
  run_tick(run, 1, 1);
  port::hold_ticks();
  asm volatile("cpsie i" ::: "memory");
  run.last_tick = run.ticks + 1;
  run_tick(run, 1, 2);
  run.last_tick = 0;
  firmware::refuse_model(run.state);
  firmware::leave(run.changes, {1, 1});
  run_tick(run, 1, 3);
}

void run_storm(firmware::Run& run, uint32_t seed) {
  constexpr uint32_t kTicks = Profile::kLeaves > 400 ? 150 : 300;
  g_inputs = {};
  StormRun storm(run, seed);
  if (storm.start() != Status::kDone) {
    print_figure("refused,", seed);
    firmware::print("\n");
    firmware::give_up();
  }
  for (uint32_t tick = 1; tick <= kTicks; ++tick) {
    storm.prepare();
    run_tick(run, seed, tick);
  }
}

constexpr uint32_t kMostCommandLine = 100;

/// The number behind a blank, from the last one back.
uint32_t take_number(char*& end) {
  uint32_t number = 0;
  uint32_t place = 1;
  for (--end; *end >= '0' && *end <= '9'; --end, place *= 10)
    number += static_cast<uint32_t>(*end - '0') * place;
  return number;
}

[[noreturn]] void run_scenes() {
  firmware::Run& run = firmware::begin_run();
  static std::array<char, kMostCommandLine> line{};
  mps2::semihosting_call(mps2::Semihosting::kCommandLine,
                         {mps2::address_of(line.data() + 1), kMostCommandLine - 2, 0});
  char* end = line.data() + 1;
  while (*end != '\0') ++end;
  const uint32_t count = take_number(end);
  if (count > 0) {
    const uint32_t first = take_number(end);
    for (uint32_t i = 0; i < count; ++i) run_scene(run, first + i);
  } else {
    for (const uint32_t seed : kWorstSeeds<Profile>) run_scene(run, seed);
    for (uint32_t seed = 1; seed <= kStorms; ++seed) run_storm(run, seed);
    for (uint32_t seed = 1; seed <= kWilds; ++seed) run_wild(run, seed);
    run_odd_ticks(run);
  }
  firmware::print("end\n");
  port::exit_program(0);
}

}  // namespace
}  // namespace palpate::worst_case

void palpate::port::run_firmware() { worst_case::run_scenes(); }
