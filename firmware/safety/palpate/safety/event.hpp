// What can happen to the state machine in a tick: the conditions, the user's requests and what boot,
// self-test, calibration and ramp report.
#pragma once

#include "palpate/safety/condition_set.hpp"

namespace palpate::safety {

/// Most urgent first: faults as in Condition, then what takes torque away, then the rest.
enum class Event : uint8_t {
  kEmergencyStop,
  kAmplifierFault,
  kWatchdog,
  kCommunicationLost,
  kCycleSlip,
  kTickOverrun,
  kEncoderRange,
  kEncoderJump,
  kEncoderStuck,
  kCorruptModel,
  kInvariantBroken,
  kMotorOverheated,
  kSelfTestFailed,
  kDisable,
  kMaxForce,
  kForceImpulse,
  kMaxVelocity,
  kWarmMotors,
  kCalibrationAborted,
  kAcknowledge,
  kBootDone,
  kSelfTestPassed,
  kCalibrationDone,
  kCalibrationStarted,
  kEnable,
  kRampDone,
  kConditionCleared  ///< nothing is raised any more; changes no state
};
inline constexpr uint32_t kEventCount = 27;

constexpr Event event_of(Condition condition) {
  constexpr auto kFirstDrop = static_cast<uint32_t>(Condition::kMaxForce);
  constexpr auto kFirstDropEvent = static_cast<uint32_t>(Event::kMaxForce);
  const auto index = static_cast<uint32_t>(condition);
  return static_cast<Event>(index < kFirstDrop ? index : index - kFirstDrop + kFirstDropEvent);
}
/// The inverse; for other events it means nothing.
constexpr Condition condition_of(Event event) {
  constexpr auto kFirstDrop = static_cast<uint32_t>(Condition::kMaxForce);
  constexpr auto kFirstDropEvent = static_cast<uint32_t>(Event::kMaxForce);
  const auto index = static_cast<uint32_t>(event);
  return static_cast<Condition>(index < kFirstDropEvent ? index : index - kFirstDropEvent + kFirstDrop);
}
static_assert(event_of(Condition::kMotorOverheated) == Event::kMotorOverheated);
static_assert(event_of(Condition::kWarmMotors) == Event::kWarmMotors);

class EventSet {
 public:
  constexpr EventSet() = default;
  static constexpr EventSet of(Event event, bool happened = true) {
    EventSet set;
    set.bits_ = happened ? uint32_t{1} << static_cast<uint32_t>(event) : 0;
    return set;
  }
  static constexpr EventSet of(ConditionSet conditions) {
    constexpr auto kFirstDrop = static_cast<uint32_t>(Condition::kMaxForce);
    constexpr uint32_t kGap = static_cast<uint32_t>(Event::kMaxForce) - kFirstDrop;
    constexpr uint32_t kLow = (uint32_t{1} << kFirstDrop) - 1;
    EventSet set;
    set.bits_ = (conditions.bits() & kLow) | (conditions.bits() & ~kLow) << kGap;
    return set;
  }
  /// Bits that are no event are left out.
  static constexpr EventSet of_bits(uint32_t bits) {
    EventSet set;
    set.bits_ = bits & ((uint32_t{1} << kEventCount) - 1);
    return set;
  }
  [[nodiscard]] constexpr bool has(Event event) const {
    return (bits_ >> static_cast<uint32_t>(event) & 1) != 0;
  }
  /// Bit n is event n: for commands and recordings.
  [[nodiscard]] constexpr uint32_t bits() const { return bits_; }
  friend constexpr EventSet operator|(EventSet a, EventSet b) {
    a.bits_ |= b.bits_;
    return a;
  }
  friend constexpr EventSet operator&(EventSet a, EventSet b) {
    a.bits_ &= b.bits_;
    return a;
  }
  constexpr EventSet& operator|=(EventSet other) { return *this = *this | other; }

 private:
  uint32_t bits_ = 0;
};

/// What the user asks for, and what boot, self-test and calibration report.
inline constexpr EventSet kRequests = EventSet::of(Event::kSelfTestFailed) | EventSet::of(Event::kDisable) |
                                      EventSet::of(Event::kCalibrationAborted) |
                                      EventSet::of(Event::kAcknowledge) | EventSet::of(Event::kBootDone) |
                                      EventSet::of(Event::kSelfTestPassed) |
                                      EventSet::of(Event::kCalibrationDone) |
                                      EventSet::of(Event::kCalibrationStarted) | EventSet::of(Event::kEnable);

constexpr const char* event_name(Event event) {
  switch (event) {
    case Event::kSelfTestFailed:
      return "self_test_failed";
    case Event::kDisable:
      return "disable";
    case Event::kCalibrationAborted:
      return "calibration_aborted";
    case Event::kAcknowledge:
      return "acknowledge";
    case Event::kBootDone:
      return "boot_done";
    case Event::kSelfTestPassed:
      return "self_test_passed";
    case Event::kCalibrationDone:
      return "calibration_done";
    case Event::kCalibrationStarted:
      return "calibration_started";
    case Event::kEnable:
      return "enable";
    case Event::kRampDone:
      return "ramp_done";
    case Event::kConditionCleared:
      return "condition_cleared";
    default:
      return condition_name(condition_of(event));
  }
}

}  // namespace palpate::safety
