// Each condition's answer: how soon it is seen, what the safety layer does, how it clears. docs/safety.md
// shows this table; a test prints it and compares.
#pragma once

#include "palpate/safety/condition_set.hpp"
#include "palpate/safety/parameters.hpp"

namespace palpate::safety {

enum class Reaction : uint8_t {
  kFault,    ///< amplifiers off, state fault: all trust in counts and machine has to be made anew
  kDrop,     ///< amplifiers off while it lasts; then the force comes back on a ramp from 0
  kRampDown  ///< the current limit falls smoothly
};

enum class Clearing : uint8_t {
  kByItself,      ///< with its cause
  kAcknowledged,  ///< with its cause; the state stays fault until the user acknowledges
  kCooled,        ///< when the motor is below a lower threshold
  kNewStart       ///< never in this run
};

struct Answer {
  uint16_t detected_in_ticks;  ///< from the first tick with its cause, that one included, by default
  Reaction reaction;
  Clearing clearing;
};

constexpr Answer answer(Condition condition) {
  constexpr Parameters kDefaults{};
  switch (condition) {
    case Condition::kCommunicationLost:
      return {kDefaults.timing.silent_ticks, Reaction::kFault, Clearing::kAcknowledged};
    case Condition::kTickOverrun:
      return {kDefaults.timing.overrun_ticks, Reaction::kFault, Clearing::kAcknowledged};
    case Condition::kEncoderStuck:
      return {kDefaults.motion.stuck_ticks, Reaction::kFault, Clearing::kAcknowledged};
    case Condition::kEncoderRange:
    case Condition::kCorruptModel:
    case Condition::kInvariantBroken:
      return {1, Reaction::kFault, Clearing::kNewStart};
    case Condition::kMaxForce:
    case Condition::kForceImpulse:
    case Condition::kMaxVelocity:
      return {1, Reaction::kDrop, Clearing::kByItself};
    case Condition::kWarmMotors:
      return {1, Reaction::kRampDown, Clearing::kCooled};
    default:
      return {1, Reaction::kFault, Clearing::kAcknowledged};
  }
}

/// For compile-time constants.
template <class Matches>
constexpr ConditionSet conditions_where(Matches matches) {
  ConditionSet set;
  for (uint32_t i = 0; i < kConditionCount; ++i) {
    const auto condition = static_cast<Condition>(i);
    set |= ConditionSet::of(condition, matches(answer(condition)));
  }
  return set;
}
inline constexpr ConditionSet kFaults =
    conditions_where([](Answer answer) { return answer.reaction == Reaction::kFault; });
inline constexpr ConditionSet kDrops =
    conditions_where([](Answer answer) { return answer.reaction == Reaction::kDrop; });
inline constexpr ConditionSet kUntilNewStart =
    conditions_where([](Answer answer) { return answer.clearing == Clearing::kNewStart; });

constexpr const char* reaction_name(Reaction reaction) {
  switch (reaction) {
    case Reaction::kFault:
      return "fault";
    case Reaction::kDrop:
      return "drop";
    default:
      return "ramp down";
  }
}

/// In the words of docs/safety.md.
constexpr const char* condition_cause(Condition condition) {
  switch (condition) {
    case Condition::kEmergencyStop:
      return "the emergency stop is pressed";
    case Condition::kAmplifierFault:
      return "an amplifier reports a fault";
    case Condition::kWatchdog:
      return "the watchdog has cut the amplifiers";
    case Condition::kCommunicationLost:
      return "no new message of the sensors for silent_ticks";
    case Condition::kCycleSlip:
      return "the tick's number is not the last one's successor";
    case Condition::kTickOverrun:
      return "overrun_ticks cycles in a row longer than a tick";
    case Condition::kEncoderRange:
      return "a count outside 16 bits";
    case Condition::kEncoderJump:
      return "more than max_counts_per_tick since the last message, for each tick between";
    case Condition::kEncoderStuck:
      return "more than moving_amperes and the same count for stuck_ticks";
    case Condition::kCorruptModel:
      return "the model's checksum is wrong";
    case Condition::kInvariantBroken:
      return "an invariant of the state does not hold";
    case Condition::kMotorOverheated:
      return "a winding at winding_limit or above";
    case Condition::kMaxForce:
      return "the force asked for is above max_newtons";
    case Condition::kForceImpulse:
      return "it changes by more than impulse_newtons_per_tick or _per_window";
    case Condition::kMaxVelocity:
      return "the tool moves by more than max_metres_per_tick";
    default:
      return "a winding above warm";
  }
}

constexpr const char* condition_clears(Condition condition) {
  switch (condition) {
    case Condition::kMotorOverheated:
      return "acknowledged, once no winding is above warm";
    case Condition::kEncoderStuck:
      return "acknowledged, once a count changes or the current ends";
    default:
      break;
  }
  switch (answer(condition).clearing) {
    case Clearing::kByItself:
      return "by itself, once the cause is gone";
    case Clearing::kAcknowledged:
      return "acknowledged, once the cause is gone";
    case Clearing::kCooled:
      return "by itself, once all windings are below release";
    default:
      return "new start";
  }
}

}  // namespace palpate::safety
