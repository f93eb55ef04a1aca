// What goes into a cycle and what comes out: the device's side of it.
#pragma once

#include "palpate/safety/safety.hpp"

namespace palpate::firmware {

/// A threshold that is to have another value (settings.hpp).
struct SettingChange {
  uint16_t setting;  ///< its number; 0: none is changed
  int32_t value;     ///< the field's raw one
};

/// What a board knows beside counts and buttons; nothing, when the counts come from a script.
struct DeviceReport {
  safety::TimingReport timing{0, 0, false};
  safety::ConditionSet reported;  ///< of safety::kReported
  safety::EventSet requests;      ///< of safety::kRequests
  SettingChange change{0, 0};     ///< takes effect in this tick
};

struct Sensors {
  std::array<int32_t, 3> encoder_counts;
  bool grasp_button;
  std::array<uint32_t, 3> gimbal{};  ///< the converters' codes; the force does not depend on them
  DeviceReport report{};
};

struct Actuators {
  std::array<uint16_t, 3> motor_codes;
  bool amplifiers_enabled;
};

inline constexpr auto kZeroCode = static_cast<uint16_t>(phantom::kZeroCode);
/// No torque. A function, so that it is three stores and no copy.
constexpr Actuators at_rest() { return {{kZeroCode, kZeroCode, kZeroCode}, false}; }

}  // namespace palpate::firmware
