// Windings and temperatures against their closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "arms.hpp"
#include "plant/motor_thermal.hpp"

namespace palpate::plant {
namespace {

using test::kSubstep;

const WindingParameters kWinding;
const ThermalParameters kThermal;

TEST(Winding, FollowsAStepWithItsTimeConstant) {
  const WindingDrive drive{true, 1.5, 0.0, 2.18};
  const double time = 0.238e-3 / 2.18;
  double current = -0.4;
  for (int i = 1; i <= 20; ++i) {
    current = advance_winding(kWinding, drive, current, kSubstep).current;
    EXPECT_NEAR(current, 1.5 - 1.9 * std::exp(-i * kSubstep / time), 1e-12);
  }
  EXPECT_NEAR(current, 1.5, 1e-6);
}

TEST(Winding, HasTheMeansOfItsCurve) {
  const WindingDrive drive{true, 2.0, 0.3, 2.5};
  const WindingStep whole = advance_winding(kWinding, drive, -1.0, kSubstep);
  double sum = 0.0;
  double square_sum = 0.0;
  constexpr int kPieces = 10000;
  for (int i = 0; i < kPieces; ++i) {
    const double i_now = advance_winding(kWinding, drive, -1.0, (i + 0.5) * kSubstep / kPieces).current;
    sum += i_now;
    square_sum += i_now * i_now;
  }
  EXPECT_NEAR(whole.mean, sum / kPieces, 1e-8);
  EXPECT_NEAR(whole.mean_square, square_sum / kPieces, 1e-8);
}

TEST(Winding, DiesAwayWhenItIsOff) {
  // Whatever is asked for, and however fast the motor turns.
  const WindingDrive off{false, 5.5, 7.0, 2.18};
  double current = 3.0;
  for (int i = 1; i <= 10; ++i) {
    current = advance_winding(kWinding, off, current, kSubstep).current;
    EXPECT_NEAR(current, 3.0 * std::exp(-i * kSubstep * 2.18 / 0.238e-3), 1e-12);
  }
  EXPECT_LT(current, 1e-3);
}

TEST(Winding, IsFedByALimitedSupply) {
  const auto settled = [](double target, double back_emf) {
    return advance_winding(kWinding, {true, target, back_emf, 2.18}, 0.0, 1.0).current;
  };
  EXPECT_NEAR(settled(5.5, 0.0), 5.5, 1e-9);
  EXPECT_NEAR(settled(5.5, 20.0), 4.0 / 2.18, 1e-9);     // 24 V - 20 V
  EXPECT_NEAR(settled(-5.5, -20.0), -4.0 / 2.18, 1e-9);  // and the other way
  EXPECT_NEAR(settled(1.0, -20.0), 1.0, 1e-9);           // the motor drives the supply
}

MotorTemperatures after(double amperes, double seconds) {
  MotorTemperatures now;
  const auto ticks = static_cast<int>(std::lround(seconds * 100));
  for (int i = 0; i < ticks; ++i) {
    now = advance_temperatures(kThermal, kWinding, now, amperes * amperes, 0.01);
  }
  return now;
}

std::optional<double> seconds_to_limit(double amperes, double at_most) {
  MotorTemperatures now;
  for (double time = 0.0; time < at_most; time += 0.001) {
    if (now.winding >= kThermal.winding_limit) return time;
    now = advance_temperatures(kThermal, kWinding, now, amperes * amperes, 0.001);
  }
  return std::nullopt;
}

TEST(MotorTemperature, ReachesTheLimitWhenItShould) {
  const double at_5_5 = seconds_to_limit(5.5, 10).value_or(0);
  const double at_3 = seconds_to_limit(3.0, 60).value_or(0);
  const double at_2 = seconds_to_limit(2.0, 400).value_or(0);
  RecordProperty("seconds_at_5_5_3_2_ampere",
                 std::to_string(at_5_5) + " " + std::to_string(at_3) + " " + std::to_string(at_2));
  EXPECT_NEAR(at_5_5, 4.6, 0.05);
  EXPECT_NEAR(at_3, 31.0, 0.5);
  EXPECT_NEAR(at_2, 240.0, 2.0);
}

TEST(MotorTemperature, StaysBelowTheLimitAtTheContinuousCurrent) {
  // dT = P (Rwh + Rha) (1 + 0.00393 dT), solved for dT.
  const double cold = 1.24 * 1.24 * 2.18 * 17.1;
  const double expected = 25.0 + cold / (1.0 - 0.00393 * cold);
  const MotorTemperatures settled = after(1.24, 8000);
  RecordProperty("settled_deg_C", std::to_string(settled.winding));
  EXPECT_NEAR(settled.winding, expected, 0.01);
  EXPECT_GT(settled.winding, 98.0);
  EXPECT_LT(settled.winding, 100.0);
}

/// With x = (Tw - 25, Th - 25): x' = A x + b, so x(t) = s + c1 v1 exp(r1 t) + c2 v2 exp(r2 t).
TEST(MotorTemperature, IsTheSumOfTwoExponentials) {
  constexpr double kSquare = 4.0;
  const double heat = kSquare * 2.18, rise = heat * 0.00393;
  const double a11 = (rise - 1 / 3.1) / 3.87, a12 = 1 / 3.1 / 3.87;
  const double a21 = 1 / 3.1 / 43.7, a22 = -(1 / 3.1 + 1 / 14.0) / 43.7;
  const double determinant = a11 * a22 - a12 * a21;
  const double b1 = heat / 3.87;
  const double settled1 = -a22 * b1 / determinant, settled2 = a21 * b1 / determinant;
  const double half = 0.5 * (a11 + a22), root = std::sqrt(half * half - determinant);
  const double r1 = half + root, r2 = half - root;
  // v = (r - a22, a21); c from x(0) = 0.
  const double c2 = (settled2 * (r1 - a22) - settled1 * a21) / (a21 * (r2 - r1));
  const double c1 = -settled2 / a21 - c2;
  for (const double seconds : {1.0, 5.0, 20.0, 100.0, 500.0}) {
    const double e1 = c1 * std::exp(r1 * seconds), e2 = c2 * std::exp(r2 * seconds);
    const MotorTemperatures now = after(2.0, seconds);
    EXPECT_NEAR(now.winding, 25 + settled1 + e1 * (r1 - a22) + e2 * (r2 - a22), 1e-6);
    EXPECT_NEAR(now.housing, 25 + settled2 + (e1 + e2) * a21, 1e-6);
  }
}

TEST(MotorTemperature, CoolsDownToTheRoom) {
  MotorTemperatures now{100.0, 60.0};
  for (int i = 0; i < 100000; ++i) {
    const MotorTemperatures next = advance_temperatures(kThermal, kWinding, now, 0.0, 0.1);
    ASSERT_LE(next.winding, now.winding);
    now = next;
  }
  EXPECT_NEAR(now.winding, 25.0, 1e-3);
  EXPECT_NEAR(now.housing, 25.0, 1e-3);
}

}  // namespace
}  // namespace palpate::plant
