// The checks of the trials must be able to object.
#include <gtest/gtest.h>

#include "checks.hpp"
#include "injector.hpp"

namespace palpate::fault {
namespace {

/// The loop after so many ticks, and checks that have seen them.
struct Watched {
  explicit Watched(uint32_t ticks) {
    while (loop.tick() < ticks) advance();
  }
  std::string advance() {
    loop.advance();
    return checks.see(loop);
  }
  Loop loop;
  Checks checks;
};

void expect_says(const std::string& failure, const std::string& part) {
  EXPECT_TRUE(failure.find(part) != std::string::npos) << failure;
}

constexpr uint32_t kRamping = 150;
constexpr uint32_t kPulling = 1370;

TEST(FaultChecks, ObjectToTorqueWithoutALeave) {
  Watched device(2);
  device.loop.advance();
  device.loop.given.motor_codes[1] = 2049;
  expect_says(device.checks.see(device.loop), "torque, where there must be none");
}

TEST(FaultChecks, ObjectToAGainAboveTheRamp) {
  Watched device(kRamping);
  device.loop.cycle.safety.ramp.gain += safety::ramp_step(kRampTicks);
  expect_says(device.advance(), "above the ramp's line");
}

TEST(FaultChecks, ObjectToCodesBeyondTheForce) {
  Watched device(kPulling);
  device.loop.advance();
  device.loop.given.motor_codes[1] = static_cast<uint16_t>(device.loop.given.motor_codes[1] + 2);
  expect_says(device.checks.see(device.loop), "motor 2 has code");
}

TEST(FaultChecks, ObjectToAConditionThatIsNotRaised) {
  Watched device(kPulling);
  device.loop.cycle.safety.parameters.ignored = safety::kMonitored;
  device.loop.timer += 1;
  expect_says(device.advance(), "not raised in time: cycle_slip");
}

TEST(FaultChecks, ObjectToAConditionWithoutACause) {
  Watched device(kPulling);
  device.loop.cycle.safety.timing.last_tick += 1;
  expect_says(device.advance(), "raised without a cause: cycle_slip");
}

TEST(FaultChecks, ObjectToAMeshThatIsNotWhole) {
  Watched device(kPulling);
  device.loop.advance();
  device.loop.cycle.core.forest.leaf[100].neighbour[2] ^= 1u;
  expect_says(device.checks.see(device.loop), "the state is not whole");
}

TEST(FaultChecks, ObjectToAWatchdogThatIsFedByALateCycle) {
  Watched device(kPulling);
  device.loop.advance();
  device.loop.now.is_late = true;
  expect_says(device.checks.see(device.loop), "has fed the watchdogs");
}

}  // namespace
}  // namespace palpate::fault
