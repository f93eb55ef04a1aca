// One cycle of the haptic controller: encoder counts in, motor codes out, a tick of soft tissue between.
//
//   kinematics   counts -> joint angles -> tool position in the body's frame
//   touch .. reaction   the core's stages (palpate/tick/tick.hpp)
//   motor_codes  reaction -> force on the handle -> joint torques -> motor codes
//
// The tick interrupt, the host board and the simulator all call this function. The same state and sensors
// give the same bits on every machine. Codes are the zero code and amplifiers off in every cycle that does
// not end well.
#pragma once

#include "palpate/firmware/scenario_image.hpp"
#include "palpate/firmware/stage.hpp"
#include "palpate/phantom/premium.hpp"
#include "palpate/tick/hash.hpp"
#include "palpate/tick/tick.hpp"

namespace palpate::firmware {

struct Sensors {
  std::array<int32_t, 3> encoder_counts;
  bool grasp_button;
};

struct Actuators {
  std::array<uint16_t, 3> motor_codes;
  bool amplifiers_enabled;
};

/// Why the cycle stands still, with no torque. Only a new start clears it.
enum class Fault : uint8_t { kNone, kNotStarted, kModelRefused, kEncoderRange };

template <class Profile>
struct CycleState {
  State<Profile> core;
  Scene scene;
  phantom::Posture posture;        // of this cycle's encoder counts
  TickInput input;                 // of the last tick
  TickOutput output;               // of the last tick
  Vector3<phantom::Newton> force;  // on the handle
  std::array<uint16_t, 3> motor_codes;
  StateHash code_history;       // of the motor codes of every cycle so far
  uint64_t peak_force_square;   // of any cycle, in (2^-27 N)^2
  uint32_t flags_seen;          // TickFlag bits of all cycles so far
  uint32_t tethers_full_ticks;  // cycles in which a change of the mesh waited for a tether
  Fault fault;
};

namespace cycle_stages {

template <class Profile>
PALPATE_NOINLINE void kinematics(CycleState<Profile>& state, const Sensors& sensors) {
  const auto angles = phantom::joint_angles(phantom::premium::kPremium15, sensors.encoder_counts);
  state.posture = phantom::premium::posture(angles);
  state.input.tool = in_body_frame(state.scene, phantom::premium::tool_position(state.posture));
  state.input.close_grasp = sensors.grasp_button;
}

template <class Profile>
PALPATE_NOINLINE void motor_codes(CycleState<Profile>& state) {
  state.force = on_handle(state.scene, state.output.reaction);
  const auto torques = phantom::premium::joint_torques(state.posture, state.force);
  state.motor_codes = phantom::motor_codes(phantom::premium::kDrive, torques).codes;
  for (const uint32_t i : bounded<3>(3, [] {})) state.code_history.add(uint32_t{state.motor_codes[i]});
  uint64_t square = 0;
  for (const uint32_t axis : bounded<3>(3, [] {})) {
    const int64_t raw = state.force[static_cast<Eigen::Index>(axis)].raw();
    square += static_cast<uint64_t>(raw * raw);
  }
  if (square > state.peak_force_square) state.peak_force_square = square;
}

}  // namespace cycle_stages

/// Builds the mesh at rest. At boot; on anything but kDone the cycle stays at zero torque.
template <class Profile>
[[nodiscard]] Status start(CycleState<Profile>& state, const CycleModel& model) {
  constexpr auto kZeroCode = static_cast<uint16_t>(phantom::kZeroCode);
  state.scene = model.scene;
  state.input = TickInput{zero_vector<Position>(), false, {RigidMotion::identity(), RigidMotion::identity()}};
  state.output = TickOutput{zero_vector<Force>(), 0};
  state.force = zero_vector<phantom::Newton>();
  state.motor_codes = {kZeroCode, kZeroCode, kZeroCode};
  state.code_history = StateHash();
  state.peak_force_square = 0;
  state.flags_seen = 0;
  state.tethers_full_ticks = 0;
  const Status status = palpate::start(state.core, model.body);
  state.fault = status == Status::kDone ? Fault::kNone : Fault::kModelRefused;
  return status;
}

template <class Profile, class Probe>
void cycle(CycleState<Profile>& state, const Sensors& sensors, Actuators& actuators, Probe& probe) {
  constexpr auto kZeroCode = static_cast<uint16_t>(phantom::kZeroCode);
  actuators = Actuators{{kZeroCode, kZeroCode, kZeroCode}, false};
  if (state.fault == Fault::kNone && !phantom::counts_in_range(sensors.encoder_counts)) {
    state.fault = Fault::kEncoderRange;
  }
  if (state.fault != Fault::kNone) return;

  probe.enter(Stage::kKinematics);
  cycle_stages::kinematics(state, sensors);
  probe.leave(Stage::kKinematics);
  CoreProbe<Probe> core_probe{probe};
  tick(state.core, state.input, state.output, core_probe);
  state.flags_seen |= state.output.flags;
  if ((state.output.flags & static_cast<uint32_t>(TickFlag::kTethersFull)) != 0) ++state.tethers_full_ticks;
  probe.enter(Stage::kMotorCodes);
  cycle_stages::motor_codes(state);
  probe.leave(Stage::kMotorCodes);
  actuators = Actuators{state.motor_codes, true};
}

/// Of what a stage wrote in the last cycle. Outside the cycle.
template <class Profile>
[[nodiscard]] uint64_t stage_hash(const CycleState<Profile>& state, Stage stage) {
  if (is_core_stage(stage)) return palpate::stage_hash(state.core, state.output, core_stage_of(stage));
  StateHash hash;
  if (stage == Stage::kKinematics) {
    hash.add(state.input.tool);
    hash.add(state.input.close_grasp ? 1u : 0u);
  } else {
    hash.add(state.force);
    hash.add(state.code_history.value());
  }
  return hash.value();
}

/// Of everything, motor codes included.
template <class Profile>
[[nodiscard]] uint64_t state_hash(const CycleState<Profile>& state) {
  StateHash hash;
  hash.add(static_cast<uint32_t>(state.fault));
  hash.add(state.core.tick);
  for (const uint32_t i : bounded<kStageCount>(kStageCount, [] {})) {
    hash.add(stage_hash(state, static_cast<Stage>(i)));
  }
  return hash.value();
}

}  // namespace palpate::firmware
