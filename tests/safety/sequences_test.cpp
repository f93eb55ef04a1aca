// Long random sequences of events and of whole ticks, against rules that are written out here once more.
#include <gtest/gtest.h>

#include "bench_arm.hpp"
#include "every.hpp"
#include "support/random.hpp"
#include "support/soak.hpp"

namespace palpate::safety {
namespace {

using palpate::test::in_soak;
using test::every_condition;
using test::every_event;
using Random = palpate::test::Random;

/// What has been achieved, instead of a state.
struct Progress {
  bool has_booted = false;
  bool is_tested = false;
  bool is_calibrating = false;
  bool is_calibrated = false;
  bool is_enabled = false;
  bool is_ramped = false;
  bool is_broken = false;

  void lose_all() { *this = {true, false, false, false, false, false, false}; }

  /// The rules, most urgent first; one of them acts in a tick.
  void see(EventSet events, bool is_fault, bool is_drop) {
    const auto has = [&events](Event event) { return events.has(event); };
    if (is_fault || (is_testing() && has(Event::kSelfTestFailed))) {
      lose_all();
      is_broken = true;
    } else if (is_broken) {
      is_broken = !has(Event::kAcknowledge);
    } else if (is_calibrated && has(Event::kDisable)) {
      is_enabled = is_ramped = false;
    } else if (is_enabled) {
      if (is_drop)
        is_ramped = false;
      else if (has(Event::kRampDone))
        is_ramped = true;
    } else if (is_calibrating) {
      if (has(Event::kCalibrationAborted))
        is_calibrating = false;
      else if (has(Event::kCalibrationDone))
        is_calibrating = false, is_calibrated = true;
    } else if (!has_booted) {
      has_booted = has(Event::kBootDone);
    } else if (!is_tested) {
      is_tested = has(Event::kSelfTestPassed);
    } else if (has(Event::kCalibrationStarted)) {
      is_calibrating = true;
      is_calibrated = false;
    } else if (is_calibrated) {
      is_enabled = has(Event::kEnable);
    }
  }
  [[nodiscard]] bool is_testing() const { return has_booted && !is_tested && !is_broken; }

  [[nodiscard]] State state() const {
    if (is_broken) return State::kFault;
    if (is_ramped) return State::kActive;
    if (is_enabled) return State::kRamping;
    if (is_calibrating) return State::kCalibrating;
    if (is_calibrated) return State::kIdle;
    if (is_tested) return State::kUncalibrated;
    return has_booted ? State::kSelfTest : State::kBoot;
  }
};

/// Each event with its own chance, so that long ways and crowded ticks both occur.
EventSet random_events(Random& random, uint32_t one_in, uint32_t fault_one_in) {
  EventSet events;
  for (const Event event : every_event()) {
    const bool is_fault = next(State::kIdle, event) == State::kFault;
    if (random.below(is_fault ? fault_one_in : one_in) == 0) events |= EventSet::of(event);
  }
  return events;
}

bool any_of(EventSet events, ConditionSet kind) {
  for (const Condition condition : every_condition()) {
    if (kind.has(condition) && events.has(event_of(condition))) return true;
  }
  return false;
}

TEST(Sequences, OfEventsLeadWhereTheRulesSay) {
  Random random(20);
  std::array<uint32_t, kStateCount> visits{};
  for (const uint32_t one_in : {2u, 4u, 12u, 40u}) {
    State state = State::kBoot;
    Progress progress;
    for (int i = 0; i < in_soak(10000000, 100000); ++i) {
      const EventSet events = random_events(random, one_in, 400 * one_in);
      progress.see(events, any_of(events, kFaults), any_of(events, kDrops));
      state = next(state, events);
      ASSERT_EQ(state, progress.state()) << one_in << " " << i;
      ++visits[static_cast<std::size_t>(state)];
    }
  }
  for (uint32_t state = 1; state < kStateCount; ++state) EXPECT_GT(visits[state], 1000u) << state;
}

/// A tick that is mostly quiet and now and then anything at all; every other 4000 ticks are calmer, so that
/// ramps come to their end.
Observation random_tick(Random& random, uint32_t number, const phantom::Counts& counts) {
  Observation seen = test::quiet(number);
  const auto sometimes = [&random](uint32_t one_in) { return random.below(one_in) == 0; };
  const uint32_t rare = number / 4000 % 2 == 0 ? 2000 : 40000;
  const auto newtons = [&random](double highest) {
    return phantom::Newton::from_raw(static_cast<int32_t>(random.centred() * highest * (1 << 27)));
  };
  seen.encoder_counts = counts;
  if (sometimes(3)) seen.asked_force = {newtons(0.3), newtons(0.3), newtons(0.3)};
  if (sometimes(rare)) seen.asked_force.x() = newtons(15);
  if (sometimes(rare)) seen.tool_position.z() = phantom::Metre::ratio(1, 100);
  if (sometimes(3 * rare)) seen.encoder_counts[random.below(3)] += 300;
  if (sometimes(3 * rare)) seen.timing.tick_number += random.below(3);
  if (sometimes(100)) seen.timing.message_number -= 1;
  if (sometimes(20)) seen.timing.is_late = true;
  if (sometimes(2)) seen.currents[random.below(3)] = Ampere::ratio(3, 1);
  if (sometimes(2 * rare)) seen.reported = ConditionSet::of(static_cast<Condition>(random.below(9)));
  for (const Event event : {Event::kAcknowledge, Event::kBootDone, Event::kSelfTestPassed,
                            Event::kCalibrationStarted, Event::kCalibrationDone, Event::kEnable}) {
    const bool is_calibration = event == Event::kCalibrationStarted;
    if (sometimes(is_calibration ? 500 : 30)) seen.requests |= EventSet::of(event);
  }
  if (sometimes(2 * rare)) seen.requests |= EventSet::of(Event::kDisable);
  return seen;
}

/// What must hold of every verdict, whatever came before.
class Watcher {
 public:
  void see(const Observation& seen, const Safety& safety, const Verdict& verdict) {
    const bool is_torque = safety.state == State::kRamping || safety.state == State::kActive;
    const bool is_dropped = safety.raised.overlaps(kDrops);
    const bool is_allowed = is_torque && !is_dropped;
    const double newtons = std::ldexp(
        Eigen::Vector3d(seen.asked_force[0].raw(), seen.asked_force[1].raw(), seen.asked_force[2].raw())
            .norm(),
        -27);
    free_ticks_ = is_allowed && newtons < 0.2 ? free_ticks_ + 1 : 0;
    if (!is_allowed) has_been_free_ = false;
    has_been_free_ = has_been_free_ || free_ticks_ > 3;

    ASSERT_EQ(verdict.amplifiers_enabled, is_allowed);
    ASSERT_TRUE((is_allowed && has_been_free_) || verdict.gain.raw() == 0);
    ASSERT_LE(verdict.gain.raw() - last_gain_, (1 << 30) / 2000);
    ASSERT_GE(verdict.gain.raw(), is_allowed ? last_gain_ : 0);
    ASSERT_LE(verdict.gain.raw(), 1 << 30);
    ASSERT_TRUE(safety.state != State::kActive || verdict.gain.raw() == 1 << 30);
    const bool is_fault = seen.reported.overlaps(kReported) || safety.raised.overlaps(kFaults);
    ASSERT_TRUE(!is_fault || safety.state == State::kFault);
    if (last_state_ != State::kActive && safety.state == State::kActive) {
      ASSERT_EQ(last_state_, State::kRamping);
      ++activations;
    }
    ASSERT_TRUE(!is_torque || is_torque_allowed(last_state_) || last_state_ == State::kIdle);
    if (last_state_ == State::kFault && safety.state != State::kFault) {
      ASSERT_EQ(safety.state, State::kSelfTest);
      ++acknowledged;
    }
    if (is_dropped && is_torque) ++drops;
    for (const Ampere limit : verdict.current_limits)
      ASSERT_GE(limit, kPremium15Parameters.thermal.continuous_amperes);
    last_gain_ = verdict.gain.raw();
    last_state_ = safety.state;
  }

  int activations = 0;
  int acknowledged = 0;
  int drops = 0;

 private:
  int free_ticks_ = 0;
  bool has_been_free_ = false;
  int32_t last_gain_ = 0;
  State last_state_ = State::kBoot;
};

TEST(Sequences, OfTicksNeverBreakTheRules) {
  int activations = 0;
  int acknowledged = 0;
  int drops = 0;
  for (uint64_t seed = 0; seed < 10; ++seed) {  // what needs a new start ends a sequence for good
    Random random(100 + seed);
    Safety safety = make_safety(kPremium15Parameters);
    Watcher watcher;
    phantom::Counts counts{};
    for (uint32_t i = 0; i < in_soak(10000000u, 100000u); ++i) {
      counts[random.below(3)] += static_cast<int32_t>(random.below(3)) - 1;
      Observation seen = random_tick(random, i, counts);
      if (i < 90000) seen.reported = seen.reported.without(kUntilNewStart);
      const Verdict verdict = test::guard(safety, seen);
      watcher.see(seen, safety, verdict);
      if (::testing::Test::HasFatalFailure()) FAIL() << "seed " << seed << ", tick " << i;
    }
    activations += watcher.activations;
    acknowledged += watcher.acknowledged;
    drops += watcher.drops;
  }
  EXPECT_GT(activations, 50);
  EXPECT_GT(acknowledged, 100);
  EXPECT_GT(drops, 100);
}

}  // namespace
}  // namespace palpate::safety
