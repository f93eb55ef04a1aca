// The states of a device that is driven.
#pragma once

#include "palpate/numeric/platform.hpp"

namespace palpate::safety {

enum class State : uint8_t {
  kBoot,
  kSelfTest,
  kUncalibrated,
  kCalibrating,
  kIdle,
  kRamping,
  kActive,
  kFault
};
inline constexpr uint32_t kStateCount = 8;

constexpr bool is_torque_allowed(State state) { return state == State::kRamping || state == State::kActive; }

/// Whether counts mean a place: calibrated, and no fault since.
constexpr bool is_calibrated(State state) {
  return state == State::kIdle || state == State::kRamping || state == State::kActive;
}

constexpr const char* state_name(State state) {
  switch (state) {
    case State::kBoot:
      return "Boot";
    case State::kSelfTest:
      return "SelfTest";
    case State::kUncalibrated:
      return "Uncalibrated";
    case State::kCalibrating:
      return "Calibrating";
    case State::kIdle:
      return "Idle";
    case State::kRamping:
      return "Ramping";
    case State::kActive:
      return "Active";
    default:
      return "Fault";
  }
}

}  // namespace palpate::safety
