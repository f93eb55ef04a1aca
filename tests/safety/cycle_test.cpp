// The whole cycle under the safety layer: counts in, motor codes out, with a bar that the tool drags.
#include <gtest/gtest.h>

#include <memory>

#include "../determinism/golden_body.hpp"
#include "bench_arm.hpp"
#include "palpate/firmware/cycle.hpp"

namespace palpate::firmware {
namespace {

using safety::Event;
using safety::State;
using safety::test::kZeroCodes;

/// Drags the bar by turning the turret, and reports as a board does.
class Device {
 public:
  Device() { EXPECT_EQ(start(*state_, kScenarioImage.model), Status::kDone); }

  Actuators tick(safety::EventSet requests = {}, safety::ConditionSet reported = {}) {
    ++number_;
    if (is_dragging && turned_ < 400) turned_ += 2;
    const Sensors sensors{{-turned_, 0, 0}, is_dragging, {}, {{number_, number_, false}, reported, requests}};
    Actuators actuators{};
    NoProbe probe;
    cycle(*state_, sensors, actuators, probe);
    return actuators;
  }
  Actuators tick(Event request) { return tick(safety::EventSet::of(request)); }
  Actuators run(int ticks) {
    Actuators last{};
    for (int i = 0; i < ticks; ++i) last = tick();
    return last;
  }
  void calibrate_and_enable() {
    for (const Event event : {Event::kBootDone, Event::kSelfTestPassed, Event::kCalibrationStarted,
                              Event::kCalibrationDone, Event::kEnable}) {
      (void)tick(event);
    }
  }
  [[nodiscard]] State state() const { return state_->safety.state; }
  [[nodiscard]] CycleState<golden::Profile>& cycle_state() { return *state_; }
  /// What the body alone would have sent.
  [[nodiscard]] std::array<uint16_t, 3> full_codes() const {
    const auto torques = phantom::premium::joint_torques(state_->posture, state_->force);
    return phantom::motor_codes(phantom::premium::kDrive, torques).codes;
  }

  bool is_dragging = false;

 private:
  std::unique_ptr<CycleState<golden::Profile>> state_ = std::make_unique<CycleState<golden::Profile>>();
  uint32_t number_ = 0;
  int32_t turned_ = 0;
};

safety::Parameters quick() {
  safety::Parameters parameters;
  parameters.ramp.step_per_tick = safety::ramp_step(64);
  return parameters;
}

TEST(GuardedCycle, OfAScriptGivesTheWholeForceFromTheFirstTickOn) {
  Device device;
  device.is_dragging = true;
  bool has_force = false;
  for (int i = 0; i < 300; ++i) {
    const Actuators actuators = device.tick();
    ASSERT_TRUE(actuators.amplifiers_enabled);
    ASSERT_EQ(actuators.motor_codes, device.full_codes());
    has_force = has_force || actuators.motor_codes != kZeroCodes;
  }
  EXPECT_TRUE(has_force);
}

TEST(GuardedCycle, OfAScriptStillHearsTheEmergencyStop) {
  Device device;
  const auto stop = safety::ConditionSet::of(safety::Condition::kEmergencyStop);
  EXPECT_FALSE(device.tick({}, stop).amplifiers_enabled);
  EXPECT_EQ(device.state(), State::kFault);
}

TEST(GuardedCycle, HasNoTorqueAndNoToolUntilItIsCalibratedAndEnabled) {
  Device device;
  ASSERT_TRUE(guard_device(device.cycle_state(), quick()));
  device.is_dragging = true;
  for (int i = 0; i < 300; ++i) {
    const Actuators actuators = device.tick(Event::kEnable);
    ASSERT_EQ(actuators.motor_codes, kZeroCodes);
    ASSERT_FALSE(actuators.amplifiers_enabled);
    ASSERT_FALSE(device.cycle_state().input.has_tool);
    ASSERT_FALSE(device.cycle_state().core.grasp.holds());
  }
  EXPECT_EQ(device.full_codes(), kZeroCodes);
}

TEST(GuardedCycle, RampsUpThenGivesTheWholeForceAndDropsItAtAFault) {
  Device device;
  ASSERT_TRUE(guard_device(device.cycle_state(), quick()));
  device.calibrate_and_enable();
  EXPECT_EQ(device.state(), State::kRamping);
  (void)device.run(100);
  ASSERT_EQ(device.state(), State::kActive);
  device.is_dragging = true;
  for (int i = 0; i < 300; ++i) {
    const Actuators actuators = device.tick();
    ASSERT_EQ(actuators.motor_codes, device.full_codes());
  }
  ASSERT_NE(device.full_codes(), kZeroCodes);
  const uint32_t ticks = device.cycle_state().core.tick;
  const auto broken = safety::ConditionSet::of(safety::Condition::kAmplifierFault);
  const Actuators last = device.tick({}, broken);
  EXPECT_EQ(last.motor_codes, kZeroCodes);
  EXPECT_FALSE(last.amplifiers_enabled);
  EXPECT_EQ(device.state(), State::kFault);
  EXPECT_EQ(device.cycle_state().core.tick, ticks + 1);  // the body goes on
}

TEST(GuardedCycle, SendsAPartOfTheForceOnTheRamp) {
  Device device;
  safety::Parameters parameters = quick();
  parameters.ramp.step_per_tick = safety::ramp_step(20000);
  ASSERT_TRUE(guard_device(device.cycle_state(), parameters));
  device.calibrate_and_enable();
  device.is_dragging = true;
  (void)device.run(300);
  ASSERT_EQ(device.state(), State::kRamping);
  int parts = 0;
  for (int i = 0; i < 8000; ++i) {
    const Actuators actuators = device.tick();
    for (std::size_t joint = 0; joint < 3; ++joint) {
      const int full = device.full_codes()[joint] - 2048;
      const double gain = std::ldexp(device.cycle_state().safety.ramp.gain.raw(), -30);
      ASSERT_NEAR(actuators.motor_codes[joint] - 2048, gain * full, 1.0);
      parts += actuators.motor_codes[joint] != 2048 && actuators.motor_codes[joint] - 2048 != full ? 1 : 0;
    }
  }
  EXPECT_GT(parts, 100);
}

TEST(GuardedCycle, RefusesParametersThatNoMonitorCanKeep) {
  Device device;
  safety::Parameters parameters;
  parameters.motion.stuck_ticks = 0;
  EXPECT_FALSE(guard_device(device.cycle_state(), parameters));
  EXPECT_FALSE(device.tick().amplifiers_enabled);
  EXPECT_EQ(device.cycle_state().fault, Fault::kParametersRefused);
  EXPECT_EQ(device.cycle_state().core.tick, 0u);
}

TEST(GuardedCycle, LimitsTheCodesToTheWarmestMotorsCurrent) {
  using safety::Ampere;
  const phantom::Drive& drive = phantom::premium::kDrive;
  const auto limit_with = [&](Ampere warmest) {
    const std::array<Ampere, 3> limits{Ampere::ratio(55, 10), warmest, Ampere::ratio(55, 10)};
    return std::ldexp(protection::limited(drive, limits).limit.raw(), -phantom::Codes::kFractionBits);
  };
  EXPECT_EQ(limit_with(Ampere::ratio(55, 10)), std::ldexp(drive.limit.raw(), -phantom::Codes::kFractionBits));
  EXPECT_NEAR(limit_with(Ampere::ratio(124, 100)), 2047 * 1.24 / 5.5, 1e-3);
  EXPECT_NEAR(limit_with(Ampere::ratio(1, 2)), 2047 * 0.5 / 5.5, 1e-3);
}

}  // namespace
}  // namespace palpate::firmware
