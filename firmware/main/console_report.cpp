#include "console_report.hpp"

#include "palpate/ports/system.hpp"
#include "text.hpp"

namespace palpate::firmware {
namespace {

// Schoolbook long division: the library's 64-bit one stays out of the image.
uint32_t divide(uint64_t dividend, uint32_t divisor) {
  if (divisor == 0) return 0;
  uint32_t quotient = 0;
  uint64_t rest = 0;
  for (int bit = 63; bit >= 0; --bit) {
    rest = 2 * rest + ((dividend >> bit) & 1);
    quotient *= 2;
    if (rest >= divisor) {
      rest -= divisor;
      quotient += 1;
    }
  }
  return quotient;
}

void begin_summary(const char* key, const char* detail = "") {
  print("summary,");
  print(key);
  print(detail);
  print(",");
}

void summarize(const char* key, const char* value) {
  begin_summary(key);
  print(value);
  print("\n");
}

template <class Integer>
void summarize(const char* key, Integer value) {
  begin_summary(key);
  print_decimal(value);
  print("\n");
}

void summarize_hex(const char* key, uint64_t value) {
  begin_summary(key);
  print_hex(value);
  print("\n");
}

void summarize_time(const char* max_key, const char* mean_key, const char* detail, const TimeFigure& time,
                    uint32_t ticks) {
  begin_summary(max_key, detail);
  print_decimal(time.max_cycles);
  print("\n");
  begin_summary(mean_key, detail);
  print_decimal(divide(time.total_cycles, ticks));
  print("\n");
}

void summarize_times(const Run& run) {
  summarize("cycles_per_second", port::cycles_per_second());
  summarize_time("max_tick_cycles", "mean_tick_cycles", "", run.timer.tick(), run.ticks);
  for (uint32_t i = 0; i < kStageCount; ++i) {
    const auto stage = static_cast<Stage>(i);
    summarize_time("max_stage_cycles.", "mean_stage_cycles.", stage_name(stage), run.timer.stage(stage),
                   run.ticks);
  }
}

}  // namespace

void print_stage_names() {
  print("stages");
  for (uint32_t i = 0; i < kStageCount; ++i) {
    print(",");
    print(stage_name(static_cast<Stage>(i)));
  }
  print("\n");
}

void print_hash_row(const Run& run) {
  print("hash,");
  print_decimal(run.ticks);
  for (uint32_t i = 0; i < kStageCount; ++i) {
    print(",");
    print_hex(stage_hash(run.state, static_cast<Stage>(i)));
  }
  print(",");
  print_hex(state_hash(run.state));
  print("\n");
}

void print_broken(uint32_t tick, const Integrity& integrity) {
  print("broken");
  const uint32_t figures[] = {tick, static_cast<uint32_t>(integrity.mesh),
                              static_cast<uint32_t>(integrity.front), integrity.tethers_hold ? 1u : 0u};
  for (const uint32_t figure : figures) {
    print(",");
    print_decimal(figure);
  }
  print("\n");
}

void print_pools(const Run& run) {
  for (uint32_t i = 0; i < kPoolCount; ++i) {
    const auto pool = static_cast<Pool>(i);
    const PoolUse use = pool_use(run.state, pool);
    print("pool,");
    print(pool_name(pool));
    const uint32_t figures[] = {use.peak, use.capacity, use.refused};
    for (const uint32_t figure : figures) {
      print(",");
      print_decimal(figure);
    }
    print("\n");
  }
}

void print_summary(const Run& run, const char* scenario) {
  summarize("profile", Profile::kName);
  summarize("scenario", scenario);
  summarize("ticks", run.ticks);
  summarize("leaves", uint32_t{run.state.core.forest.leaf_count});
  summarize("nodes", uint32_t{run.state.core.forest.nodes.used()});
  // What follows is the square, in (2^-27 N)^2: the root is the reader's.
  summarize_hex("peak_force_square", run.state.peak_force_square);
  summarize_hex("state_hash", state_hash(run.state));
  summarize("flags_seen", run.state.flags_seen);
  summarize("fault", static_cast<uint32_t>(run.state.fault));
  summarize("overruns", run.overruns);
  summarize("state_bytes", static_cast<uint32_t>(sizeof(run)));
  summarize("stack_peak_bytes", port::stack_peak_bytes());
  summarize_times(run);
}

}  // namespace palpate::firmware
