// Every state times every event, reachability, and the order of events in one tick.
#include "palpate/safety/state_machine.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <vector>

#include "every.hpp"

namespace palpate::safety {
namespace {

using test::every_condition;
using test::every_event;
using test::every_state;

/// What is expected where, written out once more: all other pairs stay.
State expected(State state, Event event) {
  static const std::set<Event> faults = {
      Event::kEmergencyStop, Event::kAmplifierFault, Event::kWatchdog,        Event::kCommunicationLost,
      Event::kCycleSlip,     Event::kTickOverrun,    Event::kEncoderRange,    Event::kEncoderJump,
      Event::kEncoderStuck,  Event::kCorruptModel,   Event::kInvariantBroken, Event::kMotorOverheated};
  static const std::set<Event> drops = {Event::kMaxForce, Event::kForceImpulse, Event::kMaxVelocity};
  struct Arrow {
    State from;
    Event event;
    State to;
  };
  static const std::vector<Arrow> arrows = {
      {State::kBoot, Event::kBootDone, State::kSelfTest},
      {State::kSelfTest, Event::kSelfTestPassed, State::kUncalibrated},
      {State::kSelfTest, Event::kSelfTestFailed, State::kFault},
      {State::kUncalibrated, Event::kCalibrationStarted, State::kCalibrating},
      {State::kIdle, Event::kCalibrationStarted, State::kCalibrating},
      {State::kCalibrating, Event::kCalibrationDone, State::kIdle},
      {State::kCalibrating, Event::kCalibrationAborted, State::kUncalibrated},
      {State::kIdle, Event::kEnable, State::kRamping},
      {State::kRamping, Event::kRampDone, State::kActive},
      {State::kRamping, Event::kDisable, State::kIdle},
      {State::kActive, Event::kDisable, State::kIdle},
      {State::kFault, Event::kAcknowledge, State::kSelfTest}};
  if (faults.count(event) != 0) return State::kFault;
  if (drops.count(event) != 0 && state == State::kActive) return State::kRamping;
  for (const Arrow& arrow : arrows) {
    if (arrow.from == state && arrow.event == event) return arrow.to;
  }
  return state;
}

TEST(StateMachine, DoesWhatIsExpectedInEveryStateAtEveryEvent) {
  for (const State state : every_state()) {
    for (const Event event : every_event()) {
      EXPECT_EQ(next(state, event), expected(state, event)) << state_name(state) << " " << event_name(event);
      EXPECT_EQ(next(state, EventSet::of(event)), next(state, event));
    }
  }
}

TEST(StateMachine, NamesEveryStateAndEventOnce) {
  std::set<std::string> names;
  for (const State state : every_state()) names.insert(state_name(state));
  for (const Event event : every_event()) names.insert(event_name(event));
  EXPECT_EQ(names.size(), kStateCount + kEventCount);
}

TEST(StateMachine, HasAnEventForEveryCondition) {
  std::set<Event> events;
  for (const Condition condition : every_condition()) {
    const Event event = event_of(condition);
    events.insert(event);
    EXPECT_EQ(condition_of(event), condition);
    EXPECT_STREQ(event_name(event), condition_name(condition));
    for (const Event other : every_event()) {
      EXPECT_EQ(EventSet::of(ConditionSet::of(condition)).has(other), other == event);
    }
  }
  EXPECT_EQ(events.size(), kConditionCount);
}

TEST(StateMachine, AllowsTorqueInRampingAndActiveOnly) {
  for (const State state : every_state()) {
    EXPECT_EQ(is_torque_allowed(state), state == State::kRamping || state == State::kActive);
  }
}

/// All states that can be reached from `start` along arrows that `may_take(from, to)` lets pass.
std::set<State> reachable(State start, const std::function<bool(State, State)>& may_take) {
  std::set<State> seen = {start};
  for (bool grows = true; grows;) {
    const std::size_t before = seen.size();
    for (const State from : every_state()) {
      for (const Event event : every_event()) {
        const State to = next(from, event);
        if (seen.count(from) != 0 && may_take(from, to)) seen.insert(to);
      }
    }
    grows = seen.size() > before;
  }
  return seen;
}

bool always(State, State) { return true; }
auto never_into(State closed) {
  return [closed](State, State to) { return to != closed; };
}

TEST(StateMachine, ReachesEveryStateFromBoot) {
  EXPECT_EQ(reachable(State::kBoot, always).size(), kStateCount);
}

TEST(StateMachine, ReachesFaultFromEveryStateInOneStep) {
  for (const State state : every_state()) {
    EXPECT_EQ(next(state, Event::kEmergencyStop), State::kFault) << state_name(state);
  }
}

TEST(StateMachine, ReachesActiveAgainFromEveryState) {
  for (const State state : every_state()) EXPECT_EQ(reachable(state, always).count(State::kActive), 1u);
}

TEST(StateMachine, HasNoWayToActiveWithoutRamping) {
  for (const State state : every_state()) {
    if (is_torque_allowed(state)) continue;
    EXPECT_EQ(reachable(state, never_into(State::kRamping)).count(State::kActive), 0u) << state_name(state);
  }
}

TEST(StateMachine, HasNoWayToRampingWithoutCalibration) {
  for (const State state : {State::kBoot, State::kSelfTest, State::kUncalibrated, State::kFault}) {
    EXPECT_EQ(reachable(state, never_into(State::kCalibrating)).count(State::kRamping), 0u)
        << state_name(state);
  }
}

TEST(StateMachine, HasNoWayOutOfFaultWithoutSelfTestAndCalibration) {
  const std::set<State> without_test = reachable(State::kFault, never_into(State::kSelfTest));
  EXPECT_EQ(without_test, std::set<State>{State::kFault});
  EXPECT_EQ(reachable(State::kFault, never_into(State::kCalibrating)).count(State::kIdle), 0u);
}

TEST(StateMachine, IsLeftForFaultWhateverElseHappens) {
  EventSet everything_else;
  for (const Event event : every_event()) {
    if (expected(State::kIdle, event) != State::kFault) everything_else |= EventSet::of(event);
  }
  for (const State state : every_state()) {
    for (const Condition condition : every_condition()) {
      if (!kFaults.has(condition)) continue;
      EXPECT_EQ(next(state, everything_else | EventSet::of(event_of(condition))), State::kFault);
    }
  }
}

TEST(StateMachine, TakesTheMostUrgentOfTwoEventsThatHasAnArrow) {
  for (const State state : every_state()) {
    for (const Event first : every_event()) {
      for (const Event second : every_event()) {
        const Event urgent = std::min(first, second);
        const Event other = std::max(first, second);
        const State to = step(state, urgent).is_arrow ? next(state, urgent) : next(state, other);
        EXPECT_EQ(next(state, EventSet::of(first) | EventSet::of(second)), to)
            << state_name(state) << " " << event_name(first) << " " << event_name(second);
      }
    }
  }
}

struct Together {
  State state;
  std::vector<Event> events;
  State to;
};

TEST(StateMachine, PrefersWhatTakesTorqueAway) {
  const std::vector<Together> cases = {
      {State::kFault, {Event::kAcknowledge, Event::kEmergencyStop}, State::kFault},
      {State::kFault, {Event::kAcknowledge, Event::kMaxForce, Event::kWarmMotors}, State::kSelfTest},
      {State::kSelfTest, {Event::kSelfTestPassed, Event::kSelfTestFailed}, State::kFault},
      {State::kCalibrating, {Event::kCalibrationDone, Event::kCalibrationAborted}, State::kUncalibrated},
      {State::kIdle, {Event::kEnable, Event::kCalibrationStarted}, State::kCalibrating},
      {State::kIdle, {Event::kEnable, Event::kDisable}, State::kIdle},
      {State::kRamping, {Event::kRampDone, Event::kMaxVelocity}, State::kRamping},
      {State::kRamping, {Event::kRampDone, Event::kDisable}, State::kIdle},
      {State::kActive, {Event::kForceImpulse, Event::kDisable}, State::kIdle},
      {State::kActive, {Event::kEnable, Event::kRampDone, Event::kConditionCleared}, State::kActive}};
  for (const Together& one : cases) {
    EventSet set;
    for (const Event event : one.events) set |= EventSet::of(event);
    EXPECT_EQ(next(one.state, set), one.to) << state_name(one.state) << " " << event_name(one.events[0]);
  }
}

}  // namespace
}  // namespace palpate::safety
