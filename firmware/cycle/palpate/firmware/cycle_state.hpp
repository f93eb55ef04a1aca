// Everything that a cycle changes, and how it comes to be: built at boot, guarded where a hand holds the
// device.
#pragma once

#include "palpate/firmware/invariant_watch.hpp"
#include "palpate/firmware/protection.hpp"
#include "palpate/firmware/scenario_image.hpp"
#include "palpate/firmware/sensors.hpp"
#include "palpate/tick/hash.hpp"
#include "palpate/tick/start.hpp"

namespace palpate::firmware {

/// Why the cycle stands still, with no torque. Only a new start clears it. What takes torque away while the
/// body goes on is in the safety layer's state.
enum class Fault : uint8_t { kNone, kNotStarted, kModelRefused, kParametersRefused };
inline constexpr Fault kLastFault = Fault::kParametersRefused;

template <class Profile>
struct CycleState {
  State<Profile> core;
  Scene scene;
  phantom::Counts counts_at_reset;  // what the encoders showed in the reset pose
  phantom::Posture posture;         // of this cycle's encoder counts
  TickInput input;                  // of the last tick
  TickOutput output;                // of the last tick
  Vector3<phantom::Newton> force;   // that the body asks for, on the handle
  safety::Safety safety;
  InvariantWatch invariants;
  bool is_setting_refused;  // the change that entered this cycle
  bool amplifiers_enabled;
  std::array<uint16_t, 3> motor_codes;
  StateHash code_history;       // of the motor codes of every cycle so far
  uint64_t peak_force_square;   // of any cycle, in (2^-27 N)^2
  uint32_t flags_seen;          // TickFlag bits of all cycles so far
  uint32_t tethers_full_ticks;  // cycles in which a change of the mesh waited for a tether
  Fault fault;
};

/// A cycle that will never move: for a model that could not be read.
template <class Profile>
void refuse_model(CycleState<Profile>& state) {
  state.amplifiers_enabled = false;
  state.motor_codes = at_rest().motor_codes;
  state.safety = safety::make_safety(safety::kPremium15Parameters);
  state.safety.state = safety::State::kFault;
  state.safety.raised = safety::ConditionSet::of(safety::Condition::kCorruptModel);
  state.fault = Fault::kModelRefused;
}

/// Builds the mesh at rest, to be driven by a script (scripted_safety). At boot; on anything but kDone the
/// cycle stays at zero torque.
template <class Profile>
[[nodiscard]] Status start(CycleState<Profile>& state, const CycleModel& model) {
  state.scene = model.scene;
  state.counts_at_reset = {0, 0, 0};
  state.input = TickInput{zero_vector<Position>(), false, {RigidMotion::identity(), RigidMotion::identity()}};
  state.output = TickOutput{zero_vector<Force>(), 0};
  state.force = zero_vector<phantom::Newton>();
  state.safety = scripted_safety();
  state.invariants = InvariantWatch{0, false};
  state.is_setting_refused = false;
  state.amplifiers_enabled = false;
  state.motor_codes = at_rest().motor_codes;
  state.code_history = StateHash();
  state.peak_force_square = 0;
  state.flags_seen = 0;
  state.tethers_full_ticks = 0;
  state.fault = Fault::kNone;
  const Status status = palpate::start(state.core, model.body);
  if (status != Status::kDone) refuse_model(state);
  return status;
}

/// After start, where a hand holds the device: from here on torque needs self-test, calibration and enable,
/// and everything is watched. False when the parameters are not usable; the cycle then stands still.
template <class Profile>
[[nodiscard]] bool guard_device(CycleState<Profile>& state, const safety::Parameters& parameters) {
  state.safety = safety::make_safety(parameters);
  state.input.has_tool = false;
  const bool is_usable = safety::is_usable(parameters);
  if (state.fault == Fault::kNone && !is_usable) state.fault = Fault::kParametersRefused;
  return is_usable;
}

}  // namespace palpate::firmware
