// What can go wrong while a device is driven. The order is the order of urgency: the first one leads.
#pragma once

#include "palpate/numeric/bounded.hpp"

namespace palpate::safety {

enum class Condition : uint8_t {
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
  kMaxForce,
  kForceImpulse,
  kMaxVelocity,
  kWarmMotors
};
inline constexpr uint32_t kConditionCount = 16;

/// Some of the conditions, a bit each.
class ConditionSet {
 public:
  constexpr ConditionSet() = default;
  static constexpr ConditionSet of(Condition condition, bool holds = true) {
    ConditionSet set;
    set.bits_ = holds ? uint32_t{1} << static_cast<uint32_t>(condition) : 0;
    return set;
  }
  /// Bits that are no condition are left out.
  static constexpr ConditionSet of_bits(uint32_t bits) {
    ConditionSet set;
    set.bits_ = bits & ((uint32_t{1} << kConditionCount) - 1);
    return set;
  }
  static constexpr ConditionSet all() {
    ConditionSet set;
    set.bits_ = (uint32_t{1} << kConditionCount) - 1;
    return set;
  }
  [[nodiscard]] constexpr bool has(Condition condition) const {
    return (bits_ >> static_cast<uint32_t>(condition) & 1) != 0;
  }
  [[nodiscard]] constexpr bool is_empty() const { return bits_ == 0; }
  [[nodiscard]] constexpr bool overlaps(ConditionSet other) const { return (bits_ & other.bits_) != 0; }
  [[nodiscard]] constexpr ConditionSet without(ConditionSet other) const {
    ConditionSet set;
    set.bits_ = bits_ & ~other.bits_;
    return set;
  }
  /// Bit n is condition n: for telemetry.
  [[nodiscard]] constexpr uint32_t bits() const { return bits_; }

  friend constexpr ConditionSet operator|(ConditionSet a, ConditionSet b) {
    a.bits_ |= b.bits_;
    return a;
  }
  friend constexpr ConditionSet operator&(ConditionSet a, ConditionSet b) {
    a.bits_ &= b.bits_;
    return a;
  }
  constexpr ConditionSet& operator|=(ConditionSet other) { return *this = *this | other; }
  friend constexpr bool operator==(ConditionSet a, ConditionSet b) { return a.bits_ == b.bits_; }
  friend constexpr bool operator!=(ConditionSet a, ConditionSet b) { return a.bits_ != b.bits_; }

 private:
  uint32_t bits_ = 0;
};

/// What a device's electronics report.
inline constexpr ConditionSet kDeviceReports = ConditionSet::of(Condition::kEmergencyStop) |
                                               ConditionSet::of(Condition::kAmplifierFault) |
                                               ConditionSet::of(Condition::kWatchdog);
/// What the monitors cannot see themselves.
inline constexpr ConditionSet kReported = kDeviceReports | ConditionSet::of(Condition::kCorruptModel) |
                                          ConditionSet::of(Condition::kInvariantBroken);
inline constexpr ConditionSet kMonitored = ConditionSet::all().without(kReported);

constexpr const char* condition_name(Condition condition) {
  switch (condition) {
    case Condition::kEmergencyStop:
      return "emergency_stop";
    case Condition::kAmplifierFault:
      return "amplifier_fault";
    case Condition::kWatchdog:
      return "watchdog";
    case Condition::kCommunicationLost:
      return "communication_lost";
    case Condition::kCycleSlip:
      return "cycle_slip";
    case Condition::kTickOverrun:
      return "tick_overrun";
    case Condition::kEncoderRange:
      return "encoder_range";
    case Condition::kEncoderJump:
      return "encoder_jump";
    case Condition::kEncoderStuck:
      return "encoder_stuck";
    case Condition::kCorruptModel:
      return "corrupt_model";
    case Condition::kInvariantBroken:
      return "invariant_broken";
    case Condition::kMotorOverheated:
      return "motor_overheated";
    case Condition::kMaxForce:
      return "max_force";
    case Condition::kForceImpulse:
      return "force_impulse";
    case Condition::kMaxVelocity:
      return "max_velocity";
    default:
      return "warm_motors";
  }
}

}  // namespace palpate::safety
