// Warm motors: the current limit falls, holds and comes back at its thresholds; a winding at its limit is a
// fault.
#include "palpate/safety/warm_motors.hpp"

#include <gtest/gtest.h>

#include "bench_arm.hpp"
#include "every.hpp"
#include "support/random.hpp"

namespace palpate::safety {
namespace {

using test::just_above;
using test::just_below;
using test::kNoCurrent;
using Random = palpate::test::Random;
using Currents = std::array<Ampere, 3>;

constexpr ThermalLimits kThermalLimits{};

WarmMotor motor_with_winding(Celsius winding, Ampere current_limit = kThermalLimits.peak_amperes) {
  return {{widen<HeatSum::kFractionBits>(winding), widen<HeatSum::kFractionBits>(winding)},
          current_limit,
          false,
          false};
}
WarmMotor after_tick(WarmMotor motor) {
  limit_current(motor, kThermalLimits);
  return motor;
}

TEST(WarmMotors, BeginAboveTheirThresholdByOneLsb) {
  EXPECT_FALSE(after_tick(motor_with_winding(just_below(kThermalLimits.warm))).is_warm);
  EXPECT_FALSE(after_tick(motor_with_winding(kThermalLimits.warm)).is_warm);
  const WarmMotor warm = after_tick(motor_with_winding(just_above(kThermalLimits.warm)));
  EXPECT_TRUE(warm.is_warm);
  EXPECT_NEAR(warm.current_limit.raw(), 0.999 * kThermalLimits.peak_amperes.raw(), 1);
}

TEST(WarmMotors, EndBelowTheirReleaseByOneLsb) {
  const auto was_warm = [](Celsius winding) {
    WarmMotor motor = motor_with_winding(winding, Ampere::ratio(3, 1));
    motor.is_warm = true;
    return after_tick(motor);
  };
  for (const Celsius between :
       {kThermalLimits.release, just_above(kThermalLimits.release), kThermalLimits.warm}) {
    EXPECT_TRUE(was_warm(between).is_warm);
    EXPECT_EQ(was_warm(between).current_limit, Ampere::ratio(3, 1));  // neither falls nor rises
  }
  EXPECT_FALSE(was_warm(just_below(kThermalLimits.release)).is_warm);
  EXPECT_EQ(was_warm(just_below(kThermalLimits.release)).current_limit,
            Ampere::ratio(3, 1) + kThermalLimits.rise_amperes_per_tick);
}

TEST(WarmMotors, FallToTheContinuousCurrentInOneAndAHalfSeconds) {
  WarmMotor motor = motor_with_winding(Celsius::ratio(90, 1));
  int ticks = 0;
  for (; motor.current_limit > kThermalLimits.continuous_amperes && ticks < 10000; ++ticks) {
    const Ampere before = motor.current_limit;
    limit_current(motor, kThermalLimits);
    ASSERT_LT(motor.current_limit, before);
    ASSERT_GE(motor.current_limit.raw() + 1, static_cast<int32_t>(0.999 * before.raw()));
  }
  EXPECT_EQ(ticks, 1489);  // ln(5.5 / 1.24) / -ln 0.999, rounded up
  for (int i = 0; i < 10000; ++i) limit_current(motor, kThermalLimits);
  EXPECT_EQ(motor.current_limit, kThermalLimits.continuous_amperes);
}

TEST(WarmMotors, ComeBackAlongALineAndNotBeyondThePeak) {
  WarmMotor motor = motor_with_winding(Celsius::ratio(30, 1), kThermalLimits.continuous_amperes);
  for (int i = 0; i < 2100; ++i) {
    const Ampere before = motor.current_limit;
    limit_current(motor, kThermalLimits);
    ASSERT_LE(motor.current_limit, before + kThermalLimits.rise_amperes_per_tick);
    ASSERT_EQ(motor.current_limit == kThermalLimits.peak_amperes, i >= 1999) << i;
  }
  EXPECT_EQ(motor.current_limit, kThermalLimits.peak_amperes);
}

TEST(MotorOverheated, IsAtTheLimitAndClearsAtTheWarmThreshold) {
  EXPECT_FALSE(after_tick(motor_with_winding(just_below(kThermalLimits.winding_limit))).is_overheated);
  WarmMotor motor = after_tick(motor_with_winding(kThermalLimits.winding_limit));
  EXPECT_TRUE(motor.is_overheated);
  motor.temperatures.winding = widen<HeatSum::kFractionBits>(just_above(kThermalLimits.warm));
  motor = after_tick(motor);
  EXPECT_TRUE(motor.is_overheated);
  motor.temperatures.winding = widen<HeatSum::kFractionBits>(kThermalLimits.warm);
  motor = after_tick(motor);
  EXPECT_FALSE(motor.is_overheated);
}

TEST(WarmMotors, AreWatchedOneByOne) {
  for (std::size_t hot = 0; hot < 3; ++hot) {
    WarmMotors motors = make_warm_motors(kThermalLimits);
    Currents currents{kNoCurrent, kNoCurrent, kNoCurrent};
    currents[hot] = -Ampere::ratio(55, 10);
    int tick_of_warm = 0;
    int tick_of_limit = 0;
    for (int tick = 1; tick <= 6000; ++tick) {
      const ConditionSet raised = watch_motors(motors, kRe25Heat, kThermalLimits, currents);
      if (raised.has(Condition::kWarmMotors) && tick_of_warm == 0) tick_of_warm = tick;
      if (raised.has(Condition::kMotorOverheated) && tick_of_limit == 0) tick_of_limit = tick;
    }
    EXPECT_GT(tick_of_warm, 3000);
    EXPECT_NEAR(tick_of_limit, 4600, 50);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(motors.motors[i].is_warm, i == hot);
      EXPECT_EQ(motors.motors[i].current_limit == kThermalLimits.peak_amperes, i != hot);
    }
  }
}

TEST(WarmMotors, KeepTheWindingBelowItsLimitWhateverIsAskedFor) {
  Random random(5);
  for (const bool is_random : {false, true}) {
    WarmMotors motors = make_warm_motors(kThermalLimits);
    Ampere asked = Ampere::ratio(55, 10);
    Celsius hottest = kThermalLimits.ambient;
    for (int tick = 0; tick < 1500000; ++tick) {
      if (is_random && random.below(3000) == 0) {
        asked =
            Ampere::from_raw(static_cast<int32_t>(random.below(static_cast<uint32_t>(Ampere::max().raw()))));
      }
      Currents currents{kNoCurrent, kNoCurrent, kNoCurrent};
      const Ampere limit = motors.motors[0].current_limit;
      currents[0] = clamp(asked, -limit, limit);
      ASSERT_FALSE(watch_motors(motors, kRe25Heat, kThermalLimits, currents).has(Condition::kMotorOverheated))
          << tick;
      const Celsius winding = celsius(motors.motors[0].temperatures.winding);
      if (winding > hottest) hottest = winding;
    }
    EXPECT_GT(hottest, kThermalLimits.warm);
    RecordProperty(is_random ? "hottest_random" : "hottest_stall", std::to_string(hottest.raw() >> 23));
  }
}

}  // namespace
}  // namespace palpate::safety
