// palpate_hash_run [ticks [every]]: runs the linked scenario on this machine and prints the hashes of the
// stages and of the whole state after every so many ticks. Nothing but the core and the cycle takes part.
// With every = 1 it finds the very tick at which two builds part. With each row it checks what must always
// hold, and after all ticks it prints the pools' peaks.
#include <cinttypes>
#include <cstdio>
#include <cstdlib>

#include "golden_body.hpp"
#include "palpate/firmware/condition.hpp"

namespace palpate::firmware {
namespace {

CycleState<golden::Profile> g_state;

void print_header() {
  std::printf("tick");
  for (uint32_t i = 0; i < kStageCount; ++i) std::printf(",%s", stage_name(static_cast<Stage>(i)));
  std::printf(",state\n");
}

void print_row(uint32_t tick) {
  std::printf("%" PRIu32, tick);
  for (uint32_t i = 0; i < kStageCount; ++i) {
    std::printf(",%016" PRIx64, stage_hash(g_state, static_cast<Stage>(i)));
  }
  std::printf(",%016" PRIx64 "\n", state_hash(g_state));
}

bool is_whole(uint32_t tick) {
  const Integrity integrity = check_integrity(g_state);
  if (integrity.is_whole()) return true;
  std::printf("broken,%" PRIu32 ",%d,%d,%d\n", tick, static_cast<int>(integrity.mesh),
              static_cast<int>(integrity.front), integrity.tethers_hold ? 1 : 0);
  return false;
}

void print_pools() {
  for (uint32_t i = 0; i < kPoolCount; ++i) {
    const auto pool = static_cast<Pool>(i);
    const PoolUse use = pool_use(g_state, pool);
    std::printf("pool,%s,%" PRIu32 ",%" PRIu32 ",%" PRIu32 "\n", pool_name(pool), use.peak, use.capacity,
                use.refused);
  }
}

uint32_t number_or(int argc, char** argv, int at, uint32_t otherwise) {
  return argc > at ? static_cast<uint32_t>(std::strtoul(argv[at], nullptr, 10)) : otherwise;
}

int run(int argc, char** argv) {
  const uint32_t asked = number_or(argc, argv, 1, kScenarioImage.row_count);
  const uint32_t ticks = asked < kScenarioImage.row_count ? asked : kScenarioImage.row_count;
  const uint32_t every = number_or(argc, argv, 2, 100);
  if (every == 0 || start(g_state, kScenarioImage.model) != Status::kDone) return EXIT_FAILURE;
  print_header();
  NoProbe probe;
  Actuators actuators{};
  for (uint32_t tick = 1; tick <= ticks; ++tick) {
    const ScriptRow& row = kScenarioImage.rows[tick - 1];
    const Sensors sensors{{row.encoder_counts[0], row.encoder_counts[1], row.encoder_counts[2]},
                          (row.buttons & ScriptRow::kGraspButton) != 0};
    cycle(g_state, sensors, actuators, probe);
    if (tick % every != 0) continue;
    print_row(tick);
    if (!is_whole(tick)) return EXIT_FAILURE;
  }
  if (ticks == kScenarioImage.row_count) print_pools();
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace palpate::firmware

int main(int argc, char** argv) { return palpate::firmware::run(argc, argv); }
