// The safety layer of a tick: watches everything, moves the state, and says how much of the force the motors
// may have. It composes the monitors; nothing else does.
//
//   observation -> monitors -> conditions -> events -> state -> gain, current limits, amplifiers
//
// A fault or a drop acts in the tick in which its monitor finds it.
#pragma once

#include "palpate/safety/encoder_monitor.hpp"
#include "palpate/safety/force_monitor.hpp"
#include "palpate/safety/force_ramp.hpp"
#include "palpate/safety/state_machine.hpp"
#include "palpate/safety/timing_monitor.hpp"
#include "palpate/safety/velocity_monitor.hpp"
#include "palpate/safety/warm_motors.hpp"

namespace palpate::safety {

/// All that a tick shows.
struct Observation {
  phantom::Counts encoder_counts;
  Position3 tool_position;         ///< in the device's frame
  Force3 asked_force;              ///< on the handle, before the gain
  std::array<Ampere, 3> currents;  ///< commanded in the last tick
  TimingReport timing;
  /// What others have found: emergency stop, amplifier fault, watchdog, corrupt model, invariant broken.
  ConditionSet reported;
  /// Requests of the user and reports of boot, self-test and calibration; all but kRequests is ignored.
  EventSet requests;
};

/// What the motors may do in this tick.
struct Verdict {
  Gain gain;                             ///< 0 unless the state allows torque
  std::array<Ampere, 3> current_limits;  ///< of |I|
  bool amplifiers_enabled;
};

struct Safety {
  Parameters parameters;
  State state;
  ConditionSet sensed;  // in this tick, by the sensors
  ConditionSet raised;  // in the last tick
  ConditionSet seen;    // in any tick since the start
  ForceRamp ramp;
  ForceMonitor force;
  VelocityMonitor velocity;
  EncoderMonitor encoders;
  TimingMonitor timing;
  WarmMotors motors;
};

inline Safety make_safety(const Parameters& parameters) {
  return {parameters,
          State::kBoot,
          ConditionSet(),
          ConditionSet(),
          ConditionSet(),
          make_force_ramp(),
          make_force_monitor(),
          make_velocity_monitor(),
          make_encoder_monitor(),
          make_timing_monitor(),
          make_warm_motors(parameters.thermal)};
}

/// First in a tick, before anything is computed from the counts: what the sensors alone show. Of `seen` it
/// reads counts, currents, timing and `reported`.
inline ConditionSet sense(Safety& safety, const Observation& seen) {
  const Parameters& p = safety.parameters;
  const TimingFindings timing = watch_timing(safety.timing, p.timing, seen.timing);
  const ConditionSet found =
      timing.conditions |
      watch_encoders(safety.encoders, p.motion, seen.encoder_counts, timing.is_new_message, seen.currents);
  safety.sensed = (seen.reported & kReported) | found.without(p.ignored);
  return safety.sensed;
}

/// What is raised in this tick. A condition that needs a new start stays.
inline ConditionSet watch(Safety& safety, const Observation& seen) {
  const Parameters& p = safety.parameters;
  const ConditionSet found = watch_velocity(safety.velocity, p.motion, seen.tool_position) |
                             watch_force(safety.force, p.force, seen.asked_force) |
                             watch_motors(safety.motors, kRe25Heat, p.thermal, seen.currents);
  return safety.sensed | (seen.reported & kReported) | (safety.raised & kUntilNewStart) |
         found.without(p.ignored);
}

/// After sense and after the reaction force, before the motor codes. Some 50 multiplies.
inline Verdict judge(Safety& safety, const Observation& seen) {
  const ConditionSet raised = watch(safety, seen);
  const bool is_cleared = raised.is_empty() && !safety.raised.is_empty();
  const bool is_ramp_done = safety.state == State::kRamping && safety.ramp.gain == kFullForce;
  const EventSet events = (seen.requests & kRequests) | EventSet::of(raised) |
                          EventSet::of(Event::kRampDone, is_ramp_done) |
                          EventSet::of(Event::kConditionCleared, is_cleared);
  safety.raised = raised;
  safety.seen |= raised;
  safety.state = next(safety.state, events);
  const bool is_allowed = is_torque_allowed(safety.state) && !raised.overlaps(kDrops);
  const Gain gain = advance(safety.ramp, safety.parameters.ramp, is_allowed, seen.asked_force);
  return {gain,
          {safety.motors.motors[0].current_limit, safety.motors.motors[1].current_limit,
           safety.motors.motors[2].current_limit},
          is_allowed};
}

}  // namespace palpate::safety
