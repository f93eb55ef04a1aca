// The firmware's static objects: everything that a run changes.
#pragma once

#include "palpate/firmware/cycle.hpp"
#include "palpate/tick/profiles.hpp"
#include "stage_timer.hpp"

namespace palpate::firmware {

using Profile = palpate::PALPATE_PROFILE;

inline constexpr uint32_t kTickPeriodUs = 1000;
inline constexpr uint32_t kHashEvery = PALPATE_HASH_EVERY;

struct Run {
  CycleState<Profile> state;
  Actuators actuators;
  StageTimer timer;
  uint32_t ticks;
  uint32_t ticks_to_hash;
  uint32_t overruns;   // cycles that ended after the next one was due
  volatile bool held;  // the cycle asks the background for a hash row; the background answers by clearing it
};

/// Holds the run without constructing it: no constructor runs before run_firmware, which does it.
union RunStorage {
  constexpr RunStorage() : nothing{} {}
  uint8_t nothing;
  Run run;
};
extern RunStorage g_storage;

inline Run& the_run() { return g_storage.run; }

}  // namespace palpate::firmware
