// One cycle of the haptic controller: encoder counts in, motor codes out, a tick of soft tissue between.
//
//   kinematics   counts -> safety layer's first look -> joint angles -> tool position in the body's frame
//   touch .. reaction   the core's stages (palpate/tick/tick.hpp)
//   motor_codes  reaction -> force on the handle -> safety layer -> joint torques -> motor codes
//
// The tick interrupt, the host board and the simulator all call this function. The same state and sensors
// give the same bits on every machine. Codes are the zero code and amplifiers off in every cycle that does
// not end well.
#pragma once

#include "palpate/firmware/cycle_state.hpp"
#include "palpate/firmware/self_test.hpp"
#include "palpate/firmware/settings.hpp"
#include "palpate/firmware/stage.hpp"
#include "palpate/tick/tick.hpp"

namespace palpate::firmware {
namespace cycle_stages {

/// While the cycle stands still no setting changes.
template <class Profile>
PALPATE_NOINLINE void apply_change(CycleState<Profile>& state, SettingChange change) {
  state.is_setting_refused =
      change.setting != 0 && (state.fault != Fault::kNone || !change_setting(state, change));
}

/// Counts that can't be trusted move no tool: before calibration, and from the tick on that shows a fault.
template <class Profile>
PALPATE_NOINLINE void kinematics(CycleState<Profile>& state, const Sensors& sensors,
                                 safety::Observation& seen) {
  const bool is_trusted = !safety::sense(state.safety, seen).overlaps(safety::kFaults) &&
                          safety::is_calibrated(state.safety.state);
  const phantom::Counts counts = phantom::in_range(sensors.encoder_counts);
  const auto angles = phantom::joint_angles(phantom::premium::kPremium15,
                                            phantom::counts_since(state.counts_at_reset, counts));
  state.posture = phantom::premium::posture(angles);
  seen.tool_position = phantom::premium::tool_position(state.posture);
  state.input.has_tool = is_trusted;
  if (is_trusted) state.input.tool = in_body_frame(state.scene, seen.tool_position);
  state.input.close_grasp = sensors.grasp_button;
}

/// What boot and self-test report by themselves.
inline safety::EventSet boot_events(safety::State state) {
  using safety::Event;
  if (state == safety::State::kBoot) return safety::EventSet::of(Event::kBootDone);
  if (state != safety::State::kSelfTest) return {};
  return safety::EventSet::of(passes_self_test() ? Event::kSelfTestPassed : Event::kSelfTestFailed);
}

/// The layer's verdict. Where it takes a calibration as done, the encoders stand in their reset pose now.
template <class Profile>
safety::Verdict judge(CycleState<Profile>& state, const safety::Observation& seen) {
  safety::Safety& safety = state.safety;
  const safety::State before = safety.state;
  const safety::Verdict verdict = safety::judge(safety, seen);
  if (before == safety::State::kCalibrating && safety.state == safety::State::kIdle) {
    state.counts_at_reset = phantom::in_range(seen.encoder_counts);
    safety.velocity = safety::make_velocity_monitor();
  }
  return verdict;
}

/// What the safety layer leaves of the force: all of it, to the bit, at full gain and with cool motors.
template <class Profile>
PALPATE_NOINLINE void motor_codes(CycleState<Profile>& state, safety::Observation& seen) {
  state.force = on_handle(state.scene, state.output.reaction);
  examine_leaf(state.core.forest, state.core.model.block, state.invariants);
  seen.asked_force = state.force;
  seen.reported |= safety::ConditionSet::of(safety::Condition::kInvariantBroken, state.invariants.is_broken);
  seen.requests |= boot_events(state.safety.state);
  const safety::Verdict verdict = judge(state, seen);
  const auto torques =
      phantom::premium::joint_torques(state.posture, safety::scaled(verdict.gain, state.force));
  const auto drive = protection::limited(phantom::premium::kDrive, verdict.current_limits);
  state.motor_codes = phantom::motor_codes(drive, torques).codes;
  state.amplifiers_enabled = verdict.amplifiers_enabled;
  for (const uint32_t i : bounded<3>(3, [] {})) state.code_history.add(uint32_t{state.motor_codes[i]});
  const uint64_t square = safety::square_norm(state.force);
  if (square > state.peak_force_square) state.peak_force_square = square;
}

}  // namespace cycle_stages

template <class Profile, class Probe>
void cycle(CycleState<Profile>& state, const Sensors& sensors, Actuators& actuators, Probe& probe) {
  actuators = at_rest();
  cycle_stages::apply_change(state, sensors.report.change);
  if (state.fault != Fault::kNone) return;

  safety::Observation seen{sensors.encoder_counts,         zero_vector<phantom::Metre>(),
                           zero_vector<phantom::Newton>(), protection::currents(state.motor_codes),
                           sensors.report.timing,          sensors.report.reported,
                           sensors.report.requests};
  probe.enter(Stage::kKinematics);
  cycle_stages::kinematics(state, sensors, seen);
  probe.leave(Stage::kKinematics);
  CoreProbe<Probe> core_probe{probe};
  tick(state.core, state.input, state.output, core_probe);
  state.flags_seen |= state.output.flags;
  if ((state.output.flags & static_cast<uint32_t>(TickFlag::kTethersFull)) != 0) ++state.tethers_full_ticks;
  probe.enter(Stage::kMotorCodes);
  cycle_stages::motor_codes(state, seen);
  probe.leave(Stage::kMotorCodes);
  actuators = Actuators{state.motor_codes, state.amplifiers_enabled};
}

/// Of what a stage wrote in the last cycle; what the safety layer did shows in the codes. Outside the cycle.
template <class Profile>
[[nodiscard]] uint64_t stage_hash(const CycleState<Profile>& state, Stage stage) {
  if (is_core_stage(stage)) return palpate::stage_hash(state.core, state.output, core_stage_of(stage));
  StateHash hash;
  if (stage == Stage::kKinematics) {
    hash.add(state.input.tool);
    hash.add((state.input.close_grasp ? 1u : 0u) | (state.input.has_tool ? 0u : 2u));
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
