// How a recorded run began.
#pragma once

#include <string>

#include "palpate/firmware/cycle_state.hpp"

namespace palpate::recording {

struct Start {
  std::string profile;
  std::string scenario;
  firmware::CycleModel model;
  bool is_guarded;  // a hand holds the device; otherwise a script drives it
  safety::Parameters parameters;
};

/// Of a state that has been started, and guarded or not. `is_guarded`: by guard_device.
template <class Profile>
Start start_of(const firmware::CycleState<Profile>& state, const std::string& scenario, bool is_guarded) {
  return {Profile::kName, scenario, {state.core.model, state.scene}, is_guarded, state.safety.parameters};
}

/// The state as it was then.
template <class Profile>
[[nodiscard]] Status begin_again(const Start& start, firmware::CycleState<Profile>& state) {
  const Status status = firmware::start(state, start.model);
  if (status != Status::kDone) return status;
  if (!start.is_guarded) {
    state.safety.parameters = start.parameters;
  } else if (!firmware::guard_device(state, start.parameters)) {
    state.fault = firmware::Fault::kParametersRefused;
  }
  return status;
}

}  // namespace palpate::recording
