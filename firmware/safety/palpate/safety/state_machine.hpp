// The states of a device that is driven, and what leads from one to another. Torque is allowed in ramping and
// active only, and every way there leads through self-test, calibration and, for active, the ramp.
//
// One arrow at most is taken in a tick: that of the most urgent event that has one (next(State, EventSet)).
// The events are listed in the order of their urgency. A fault has an arrow from every state, fault included,
// so it outranks all that a user asks for: an acknowledgement while the cause lasts does nothing.
#pragma once

#include "palpate/safety/conditions.hpp"
#include "palpate/safety/event.hpp"
#include "palpate/safety/state.hpp"

namespace palpate::safety {

/// An entry of the table: where an event leads, or that the state stays. An arrow from a state to itself is
/// not the same as staying: it keeps less urgent events of the tick from being taken.
struct Step {
  State to;
  bool is_arrow;
};
using Row = std::array<Step, kStateCount>;

namespace state_table {

inline constexpr Step kStays{State::kBoot, false};
inline constexpr Step kTest{State::kSelfTest, true};
inline constexpr Step kUncal{State::kUncalibrated, true};
inline constexpr Step kCalib{State::kCalibrating, true};
inline constexpr Step kIdle{State::kIdle, true};
inline constexpr Step kRamping{State::kRamping, true};
inline constexpr Step kActive{State::kActive, true};
inline constexpr Step kFault{State::kFault, true};

inline constexpr Row kAllStay{kStays, kStays, kStays, kStays, kStays, kStays, kStays, kStays};
inline constexpr Row kAllFault{kFault, kFault, kFault, kFault, kFault, kFault, kFault, kFault};
inline constexpr Row kRampAnew{kStays, kStays, kStays, kStays, kStays, kRamping, kRamping, kStays};

constexpr Row condition_row(Reaction reaction) {
  switch (reaction) {
    case Reaction::kFault:
      return kAllFault;
    case Reaction::kDrop:
      return kRampAnew;
    default:
      return kAllStay;
  }
}

// clang-format off
/// What an event does in each state; a condition, what its reaction demands.
constexpr Row row(Event event) {
  switch (event) {
    // in:    boot    test    uncal   calib   idle    ramping  active  fault
    case Event::kSelfTestFailed:
      return {kStays, kFault, kStays, kStays, kStays, kStays,  kStays, kStays};
    case Event::kDisable:
      return {kStays, kStays, kStays, kStays, kIdle,  kIdle,   kIdle,  kStays};
    case Event::kCalibrationAborted:
      return {kStays, kStays, kStays, kUncal, kStays, kStays,  kStays, kStays};
    case Event::kAcknowledge:
      return {kStays, kStays, kStays, kStays, kStays, kStays,  kStays, kTest};
    case Event::kBootDone:
      return {kTest,  kStays, kStays, kStays, kStays, kStays,  kStays, kStays};
    case Event::kSelfTestPassed:
      return {kStays, kUncal, kStays, kStays, kStays, kStays,  kStays, kStays};
    case Event::kCalibrationDone:
      return {kStays, kStays, kStays, kIdle,  kStays, kStays,  kStays, kStays};
    case Event::kCalibrationStarted:
      return {kStays, kStays, kCalib, kStays, kCalib, kStays,  kStays, kStays};
    case Event::kEnable:
      return {kStays, kStays, kStays, kStays, kRamping,kStays,  kStays, kStays};
    case Event::kRampDone:
      return {kStays, kStays, kStays, kStays, kStays, kActive, kStays, kStays};
    case Event::kConditionCleared:
      return kAllStay;
    default:
      return condition_row(answer(condition_of(event)).reaction);
  }
}
// clang-format on

/// For compile-time constants.
constexpr std::array<Row, kEventCount> make_table() {
  std::array<Row, kEventCount> table{};
  for (uint32_t i = 0; i < kEventCount; ++i) {
    table[i] = row(static_cast<Event>(i));
  }
  return table;
}
inline constexpr std::array<Row, kEventCount> kTable = make_table();

}  // namespace state_table

constexpr Step step(State state, Event event) {
  return state_table::kTable[static_cast<std::size_t>(event)][static_cast<std::size_t>(state)];
}

/// Straight-line, a table look-up.
constexpr State next(State state, Event event) {
  const Step taken = step(state, event);
  return taken.is_arrow ? taken.to : state;
}

/// Takes the first event of the set that has an arrow; the others of this tick are lost. 27 look-ups.
inline State next(State state, EventSet events) {
  State to = state;
  bool is_taken = false;
  for (const uint32_t i : bounded<kEventCount>(kEventCount, [] {})) {
    const auto event = static_cast<Event>(i);
    const Step candidate = step(state, event);
    if (is_taken || !candidate.is_arrow || !events.has(event)) continue;
    to = candidate.to;
    is_taken = true;
  }
  return to;
}

}  // namespace palpate::safety
