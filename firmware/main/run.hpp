// The firmware's static objects: everything that a run changes.
#pragma once

#include "palpate/firmware/cycle.hpp"
#include "palpate/telemetry/tick_record.hpp"
#include "palpate/tick/profiles.hpp"
#include "stage_timer.hpp"

namespace palpate::firmware {

using Profile = palpate::PALPATE_PROFILE;

inline constexpr uint32_t kTickPeriodUs = 1000;
inline constexpr uint32_t kTelemetryTicks = 16;             // that the background may be late
inline constexpr uint32_t kWaiting = 8;                     // of a kind that have not had their tick
inline constexpr uint32_t kHashEvery = PALPATE_HASH_EVERY;  // 0: never

struct Run {
  CycleState<Profile> state;
  Actuators actuators;
  StageTimer timer;
  uint32_t ticks;
  uint32_t ticks_to_hash;
  uint32_t last_tick;  // the run ends with it; 0: never
  uint32_t overruns;   // cycles that ended after the next one was due
  bool was_late;       // the last cycle did
  volatile bool held;  // the cycle asks the background for a hash row; the background answers by clearing it
  telemetry::Ring<telemetry::TickRecord, kTelemetryTicks> telemetry;
  // What the background leaves for the cycle, which takes one of each a tick.
  telemetry::Ring<safety::EventSet, kWaiting> requests;      // of whoever commands the device
  telemetry::Ring<SettingChange, kWaiting> changes;          // that they want
  telemetry::Ring<safety::ConditionSet, kWaiting> findings;  // of the background itself
};

/// One more for the cycle; the background's. When so many wait already it is lost: nobody asks for as much.
template <class Item>
void leave(telemetry::Ring<Item, kWaiting>& ring, Item item) {
  if (Item* const place = ring.claim()) {
    *place = item;
    ring.publish();
  }
}

/// The next one, or nothing; the cycle's.
template <class Item>
[[nodiscard]] Item take(telemetry::Ring<Item, kWaiting>& ring) {
  const Item* const waiting = ring.oldest();
  if (waiting == nullptr) return {};
  const Item item = *waiting;
  ring.release();
  return item;
}

/// Holds the run without constructing it: no constructor runs before run_firmware, which does it.
union RunStorage {
  constexpr RunStorage() : nothing{} {}
  uint8_t nothing;
  Run run;
};
extern RunStorage g_storage;

inline Run& the_run() { return g_storage.run; }

}  // namespace palpate::firmware
