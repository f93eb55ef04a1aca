// Watches the clockwork: messages of the sensors that stay away, ticks that were skipped, cycles that are
// longer than their tick.
#pragma once

#include "palpate/safety/condition_set.hpp"
#include "palpate/safety/parameters.hpp"

namespace palpate::safety {

struct TimingMonitor {
  uint32_t last_tick;     // its number
  uint32_t last_message;  // its number
  uint16_t silent_ticks;
  uint16_t overruns;  // in a row
  bool is_primed;
};

constexpr TimingMonitor make_timing_monitor() { return {0, 0, 0, 0, false}; }

struct TimingReport {
  uint32_t tick_number;     ///< of the timer, + 1 every period, modulo 2^32
  uint32_t message_number;  ///< of the sensors' last message, modulo 2^32; another number is a new message
  bool is_late;             ///< the last cycle ended after this one was due
};

struct TimingFindings {
  ConditionSet conditions;
  bool is_new_message;
};

/// The first tick skips nothing, and its message is new. Straight-line.
inline TimingFindings watch_timing(TimingMonitor& monitor, const TimingLimits& limits,
                                   const TimingReport& report) {
  const bool is_slip = monitor.is_primed && report.tick_number != monitor.last_tick + 1;
  const bool is_new = !monitor.is_primed || report.message_number != monitor.last_message;
  const auto count = [](uint16_t ticks, uint16_t enough) {
    return static_cast<uint16_t>(ticks < enough ? ticks + 1 : enough);
  };
  monitor.silent_ticks = is_new ? uint16_t{0} : count(monitor.silent_ticks, limits.silent_ticks);
  monitor.overruns = report.is_late ? count(monitor.overruns, limits.overrun_ticks) : uint16_t{0};
  monitor.last_tick = report.tick_number;
  monitor.last_message = report.message_number;
  monitor.is_primed = true;
  const bool is_lost = monitor.silent_ticks >= limits.silent_ticks;
  return {ConditionSet::of(Condition::kCommunicationLost, is_lost) |
              ConditionSet::of(Condition::kCycleSlip, is_slip) |
              ConditionSet::of(Condition::kTickOverrun, monitor.overruns >= limits.overrun_ticks),
          is_new};
}

}  // namespace palpate::safety
