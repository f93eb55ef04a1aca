// Each condition in the whole layer: detected as soon as the table says, answered as it says, cleared as it
// says.
#include "palpate/safety/conditions.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "bench_arm.hpp"
#include "every.hpp"

namespace palpate::safety {
namespace {

using phantom::Newton;
using test::BenchArm;
using test::every_condition;
using test::force_along_x;

/// What makes a condition hold, in the n-th tick of its cause (from 1).
struct Cause {
  std::function<void(Observation&, int)> spoil;
  bool is_lasting = true;  // false: a step, which is a cause in its first tick only and then stays
};

Cause reported(Condition condition) {
  return {[condition](Observation& seen, int) { seen.reported = ConditionSet::of(condition); }};
}

Cause cause_of(Condition condition) {
  switch (condition) {
    case Condition::kCommunicationLost:
      return {[](Observation& seen, int tick) { seen.timing.message_number -= static_cast<uint32_t>(tick); }};
    case Condition::kCycleSlip:
      return {[](Observation& seen, int) { ++seen.timing.tick_number; }, false};
    case Condition::kTickOverrun:
      return {[](Observation& seen, int) { seen.timing.is_late = true; }};
    case Condition::kEncoderRange:
      return {[](Observation& seen, int) { seen.encoder_counts[1] = 32768; }};
    case Condition::kEncoderJump:
      return {[](Observation& seen, int) { seen.encoder_counts[2] = 206; }, false};
    case Condition::kEncoderStuck:
      return {[](Observation& seen, int) { seen.currents[0] = Ampere::ratio(1, 1); }};
    case Condition::kMaxForce:
      return {[](Observation& seen, int) { seen.asked_force = force_along_x(Newton::ratio(86, 10)); }};
    case Condition::kForceImpulse:
      return {[](Observation& seen, int) { seen.asked_force = force_along_x(Newton::ratio(2, 1)); }, false};
    case Condition::kMaxVelocity:
      return {[](Observation& seen, int) { seen.tool_position.y() = phantom::Metre::ratio(3, 1000); }, false};
    default:
      return reported(condition);
  }
}

/// A motor that is heated from outside: the table counts from the tick in which its winding is too warm.
void set_winding(Safety& safety, Celsius winding) {
  safety.motors.motors[0].temperatures.winding = widen<HeatSum::kFractionBits>(winding);
}

bool is_heat(Condition condition) {
  return condition == Condition::kWarmMotors || condition == Condition::kMotorOverheated;
}

/// A tick of the cause; for heat the winding is set before it, with room for what a tick loses.
Verdict tick_with_cause(BenchArm& arm, Condition condition, int tick) {
  const ThermalLimits& limits = arm.safety.parameters.thermal;
  if (is_heat(condition)) {
    const bool is_limit = condition == Condition::kMotorOverheated;
    set_winding(arm.safety, (is_limit ? limits.winding_limit : limits.warm) + Celsius::ratio(1, 10));
    return arm.tick();
  }
  const Cause cause = cause_of(condition);
  return arm.tick([&](Observation& seen) { cause.spoil(seen, tick); });
}

TEST(Conditions, AreDetectedInTheTickThatTheTableSays) {
  for (const Condition condition : every_condition()) {
    SCOPED_TRACE(condition_name(condition));
    BenchArm arm;
    arm.reach_active();
    ASSERT_EQ(arm.safety.state, State::kActive);
    ASSERT_TRUE(arm.safety.seen.is_empty());
    const int delay = answer(condition).detected_in_ticks;
    for (int tick = 1; tick <= delay; ++tick) {
      ASSERT_FALSE(arm.safety.raised.has(condition)) << tick;
      (void)tick_with_cause(arm, condition, tick);
    }
    EXPECT_TRUE(arm.safety.raised.has(condition));
    EXPECT_TRUE(arm.safety.seen.has(condition));
  }
}

TEST(Conditions, AreAnsweredInTheSameTickAsTheTableSays) {
  for (const Condition condition : every_condition()) {
    SCOPED_TRACE(condition_name(condition));
    BenchArm arm;
    arm.reach_active();
    Verdict verdict{};
    for (int tick = 1; tick <= answer(condition).detected_in_ticks; ++tick) {
      verdict = tick_with_cause(arm, condition, tick);
    }
    const bool keeps_force = answer(condition).reaction == Reaction::kRampDown;
    EXPECT_EQ(verdict.gain, keeps_force ? kFullForce : kNoForce);
    EXPECT_EQ(verdict.amplifiers_enabled, keeps_force);
    switch (answer(condition).reaction) {
      case Reaction::kFault:
        EXPECT_EQ(arm.safety.state, State::kFault);
        break;
      case Reaction::kDrop:
        EXPECT_EQ(arm.safety.state, State::kRamping);
        break;
      default:
        EXPECT_EQ(arm.safety.state, State::kActive);
        EXPECT_LT(verdict.current_limits[0], kPremium15Parameters.thermal.peak_amperes);
    }
  }
}

/// The first tick without the cause.
void tick_without_cause(BenchArm& arm, Condition condition) {
  const ThermalLimits& limits = arm.safety.parameters.thermal;
  if (condition == Condition::kMotorOverheated) set_winding(arm.safety, limits.warm);
  if (condition == Condition::kWarmMotors) {
    set_winding(arm.safety, limits.release + Celsius::ratio(1, 10));
    (void)arm.tick();
    EXPECT_TRUE(arm.safety.raised.has(condition));  // below `warm` is not enough
    set_winding(arm.safety, limits.release);
  }
  if (is_heat(condition) || cause_of(condition).is_lasting) {
    (void)arm.tick();
  } else {
    (void)tick_with_cause(arm, condition, 2);
  }
}

void bring_about(BenchArm& arm, Condition condition, bool is_expected = true) {
  arm.reach_active();
  for (int tick = 1; tick <= answer(condition).detected_in_ticks; ++tick) {
    (void)tick_with_cause(arm, condition, tick);
  }
  const int more = is_heat(condition) || cause_of(condition).is_lasting ? 5 : 0;
  for (int tick = 1; tick <= more; ++tick) {
    (void)tick_with_cause(arm, condition, answer(condition).detected_in_ticks + tick);
  }
  EXPECT_EQ(arm.safety.raised.has(condition), is_expected);
}

TEST(Conditions, ClearAsTheTableSays) {
  for (const Condition condition : every_condition()) {
    SCOPED_TRACE(condition_name(condition));
    BenchArm arm;
    bring_about(arm, condition);
    tick_without_cause(arm, condition);
    const bool is_for_ever = answer(condition).clearing == Clearing::kNewStart;
    EXPECT_EQ(arm.safety.raised.has(condition), is_for_ever);
    if (answer(condition).reaction != Reaction::kFault) continue;
    EXPECT_EQ(arm.run(3000).gain, kNoForce);
    EXPECT_EQ(arm.safety.state, State::kFault);  // until the user acknowledges
    (void)arm.tick(Event::kAcknowledge);
    EXPECT_EQ(arm.safety.state, is_for_ever ? State::kFault : State::kSelfTest);
    (void)arm.tick(Event::kEnable);
    EXPECT_NE(arm.safety.state, State::kRamping);
  }
}

TEST(Conditions, ThatLastAreNotAcknowledged) {
  for (const Condition condition : every_condition()) {
    if (answer(condition).reaction != Reaction::kFault || is_heat(condition)) continue;
    if (!cause_of(condition).is_lasting) continue;
    SCOPED_TRACE(condition_name(condition));
    BenchArm arm;
    bring_about(arm, condition);
    for (int tick = 6; tick < 20; ++tick) {
      const Cause cause = cause_of(condition);
      (void)arm.tick([&](Observation& seen) {
        cause.spoil(seen, answer(condition).detected_in_ticks + tick);
        seen.requests = EventSet::of(Event::kAcknowledge);
      });
      EXPECT_EQ(arm.safety.state, State::kFault);
    }
  }
}

TEST(Conditions, ThatDropTheForceLetItComeBackOnARamp) {
  for (const Condition condition : every_condition()) {
    if (answer(condition).reaction != Reaction::kDrop) continue;
    SCOPED_TRACE(condition_name(condition));
    BenchArm arm;
    bring_about(arm, condition);
    (void)arm.run(9);
    ASSERT_TRUE(arm.safety.raised.is_empty());
    Gain last = arm.safety.ramp.gain;
    EXPECT_LT(last, Gain::ratio(1, 100));
    for (int i = 0; i < 2005; ++i) {
      const Verdict verdict = arm.tick();
      ASSERT_LE(verdict.gain - last, kPremium15Parameters.ramp.step_per_tick);
      ASSERT_TRUE(verdict.amplifiers_enabled);
      last = verdict.gain;
    }
    EXPECT_EQ(arm.safety.state, State::kActive);
    EXPECT_EQ(last, kFullForce);
  }
}

TEST(Conditions, OfTheMonitorsCannotBeReportedAndRequestsAreNoConditions) {
  for (const Condition condition : every_condition()) {
    BenchArm arm;
    arm.reach_active();
    (void)arm.tick([&](Observation& seen) {
      seen.reported = ConditionSet::of(condition);
      seen.requests = EventSet::of(Event::kRampDone) | EventSet::of(event_of(condition));
    });
    EXPECT_EQ(arm.safety.raised.has(condition), kReported.has(condition));
    EXPECT_EQ(arm.safety.state, kReported.has(condition) ? State::kFault : State::kActive);
  }
}

TEST(Conditions, ThatAreIgnoredAreThoseOfTheMonitorsOnly) {
  Parameters parameters;
  parameters.ignored = ConditionSet::all();
  for (const Condition condition : every_condition()) {
    BenchArm arm(parameters);
    bring_about(arm, condition, kReported.has(condition));
    EXPECT_EQ(arm.safety.state, kReported.has(condition) ? State::kFault : State::kActive);
    EXPECT_EQ(arm.safety.seen.is_empty(), !kReported.has(condition)) << condition_name(condition);
  }
}

TEST(Conditions, ReactAsTheirKindAndAreNamedOnce) {
  std::set<std::string> names;
  std::set<std::string> causes;
  for (const Condition condition : every_condition()) {
    names.insert(condition_name(condition));
    causes.insert(condition_cause(condition));
    EXPECT_GE(answer(condition).detected_in_ticks, 1);
    EXPECT_EQ(kFaults.has(condition), answer(condition).reaction == Reaction::kFault);
    EXPECT_EQ(kDrops.has(condition), answer(condition).reaction == Reaction::kDrop);
  }
  EXPECT_EQ(names.size(), kConditionCount);
  EXPECT_EQ(causes.size(), kConditionCount);
  EXPECT_FALSE(kFaults.overlaps(kDrops));
}

}  // namespace
}  // namespace palpate::safety
