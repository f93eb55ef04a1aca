// The cycle of a device that a hand holds: calibration, counts that can't be trusted, a mesh that breaks.
#include <gtest/gtest.h>

#include <memory>

#include "../determinism/golden_body.hpp"
#include "bench_arm.hpp"
#include "palpate/firmware/cycle.hpp"

namespace palpate::firmware {
namespace {

using safety::Condition;
using safety::Event;
using safety::EventSet;
using safety::State;
using safety::test::kZeroCodes;

class GuardedDevice {
 public:
  GuardedDevice() {
    EXPECT_EQ(start(*state_, kScenarioImage.model), Status::kDone);
    EXPECT_TRUE(guard_device(*state_, safety::kPremium15Parameters));
  }
  Actuators tick(EventSet requests = {}) {
    ++number_;
    const Sensors sensors{counts, is_grasping, {}, {{number_, number_, false}, {}, requests}};
    Actuators actuators{};
    NoProbe probe;
    cycle(*state_, sensors, actuators, probe);
    return actuators;
  }
  void calibrate() {
    (void)tick();
    (void)tick();
    (void)tick(EventSet::of(Event::kCalibrationStarted));
    (void)tick(EventSet::of(Event::kCalibrationDone));
  }
  CycleState<golden::Profile>& state() { return *state_; }
  [[nodiscard]] State safety_state() const { return state_->safety.state; }
  [[nodiscard]] Vector3<phantom::Metre> tool() const {
    return phantom::premium::tool_position(state_->posture);
  }

  phantom::Counts counts{};
  bool is_grasping = false;

 private:
  std::unique_ptr<CycleState<golden::Profile>> state_ = std::make_unique<CycleState<golden::Profile>>();
  uint32_t number_ = 0;
};

TEST(DeviceCycle, BootsAndTestsItselfWithoutBeingAsked) {
  GuardedDevice device;
  EXPECT_EQ(device.safety_state(), State::kBoot);
  (void)device.tick();
  EXPECT_EQ(device.safety_state(), State::kSelfTest);
  (void)device.tick();
  EXPECT_EQ(device.safety_state(), State::kUncalibrated);
}

TEST(DeviceCycle, PassesItsSelfTest) { EXPECT_TRUE(passes_self_test()); }

/// Where the encoders began to count does not matter: calibrated, the reset pose is that of the links
/// orthogonal.
TEST(DeviceCycle, CountsFromTheResetPoseOnceItIsCalibrated) {
  GuardedDevice device;
  GuardedDevice at_zero;
  device.counts = {1234, -567, 89};
  device.calibrate();
  at_zero.calibrate();
  EXPECT_EQ(device.safety_state(), State::kIdle);
  for (int i = 0; i < 50; ++i) {
    device.counts[1] -= 3;
    at_zero.counts[1] -= 3;
    (void)device.tick();
    (void)at_zero.tick();
    ASSERT_EQ(device.tool(), at_zero.tool());
    ASSERT_TRUE(device.state().input.has_tool);
    ASSERT_TRUE(device.state().safety.raised.is_empty());
  }
}

TEST(DeviceCycle, HasAToolOnlyWhileItIsCalibrated) {
  GuardedDevice device;
  device.calibrate();
  (void)device.tick();
  EXPECT_TRUE(device.state().input.has_tool);
  (void)device.tick(EventSet::of(Event::kCalibrationStarted));
  (void)device.tick();
  EXPECT_EQ(device.safety_state(), State::kCalibrating);
  EXPECT_FALSE(device.state().input.has_tool);
}

/// The tick that shows the jump moves no tool, and no tick after it does.
TEST(DeviceCycle, LetsAJumpOfCountsMoveNothing) {
  GuardedDevice device;
  device.calibrate();
  (void)device.tick(EventSet::of(Event::kEnable));
  device.is_grasping = true;
  for (int i = 0; i < 20; ++i) (void)device.tick();
  const Vector3<Position> before = device.state().input.tool;
  device.counts[0] += 2000;
  for (int i = 0; i < 20; ++i) {
    const Actuators actuators = device.tick();
    ASSERT_EQ(actuators.motor_codes, kZeroCodes);
    ASSERT_FALSE(actuators.amplifiers_enabled);
    ASSERT_EQ(device.state().input.tool, before);
    ASSERT_FALSE(device.state().core.grasp.holds());
    ASSERT_EQ(device.safety_state(), State::kFault);
  }
  EXPECT_TRUE(device.state().safety.seen.has(Condition::kEncoderJump));
}

TEST(DeviceCycle, StaysInFaultAfterACountOutsideItsRange) {
  GuardedDevice device;
  device.calibrate();
  device.counts[2] = 40000;
  (void)device.tick();
  EXPECT_EQ(device.safety_state(), State::kFault);
  device.counts[2] = 0;
  for (int i = 0; i < 20; ++i) (void)device.tick(EventSet::of(Event::kAcknowledge));
  EXPECT_EQ(device.safety_state(), State::kFault);
}

/// A link of the mesh that is wrong is found within one look at all leaves, and ends all torque.
TEST(DeviceCycle, FindsABrokenMesh) {
  GuardedDevice device;
  device.calibrate();
  (void)device.tick(EventSet::of(Event::kEnable));
  Forest<golden::Profile>& forest = device.state().core.forest;
  Leaf& leaf = forest.leaf[forest.leaf_count / 2];
  std::swap(leaf.neighbour[0], leaf.neighbour[1]);
  uint32_t ticks = 0;
  while (device.safety_state() != State::kFault && ticks < 1000) {
    (void)device.tick();
    ++ticks;
  }
  EXPECT_LE(ticks, forest.leaf_count + 1u);
  EXPECT_TRUE(device.state().safety.seen.has(Condition::kInvariantBroken));
  EXPECT_EQ(device.tick(EventSet::of(Event::kAcknowledge)).motor_codes, kZeroCodes);
  EXPECT_EQ(device.safety_state(), State::kFault);
}

TEST(DeviceCycle, StandsStillWithAModelThatWasRefused) {
  auto state = std::make_unique<CycleState<golden::Profile>>();
  refuse_model(*state);
  NoProbe probe;
  for (int i = 0; i < 10; ++i) {
    Actuators actuators{};
    cycle(*state, Sensors{{}, false, {}, {{}, {}, safety::kRequests}}, actuators, probe);
    EXPECT_EQ(actuators.motor_codes, kZeroCodes);
    EXPECT_FALSE(actuators.amplifiers_enabled);
  }
  EXPECT_EQ(state->safety.state, State::kFault);
  EXPECT_TRUE(state->safety.raised.has(Condition::kCorruptModel));
}

}  // namespace
}  // namespace palpate::firmware
