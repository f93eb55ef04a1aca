// The thermal model against its differential equations in double precision, in closed form and by
// Runge-Kutta.
#include "palpate/safety/motor_heat.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <complex>

#include "palpate/phantom/premium.hpp"
#include "support/random.hpp"

namespace palpate::safety {
namespace {

using Random = palpate::test::Random;
using Temperatures = Eigen::Vector2d;  // winding, housing

constexpr double kAmbient = 25;
constexpr Celsius kAmbientFixed = Celsius::ratio(25, 1);

/// T' = A T + b, linear because the copper's resistance is.
struct HeatFlow {
  Eigen::Matrix2d A;
  Eigen::Vector2d b;

  explicit HeatFlow(double amperes) {
    const double square = amperes * amperes;
    const double Cw = 3.87, Ch = 43.7, Rwh = 3.1, Rha = 14, R = 2.18, alpha = 0.00393;
    A << square * R * alpha / Cw - 1 / (Rwh * Cw), 1 / (Rwh * Cw), 1 / (Rwh * Ch),
        -1 / (Rwh * Ch) - 1 / (Rha * Ch);
    b << square * R * (1 - alpha * 25) / Cw, kAmbient / (Rha * Ch);
  }
  [[nodiscard]] Temperatures slope(const Temperatures& T) const { return A * T + b; }

  [[nodiscard]] Temperatures runge_kutta(const Temperatures& T, double dt) const {
    const Temperatures k1 = slope(T);
    const Temperatures k2 = slope(T + 0.5 * dt * k1);
    const Temperatures k3 = slope(T + 0.5 * dt * k2);
    const Temperatures k4 = slope(T + dt * k3);
    return T + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  /// T(t) = T_end + V exp(L t) V^-1 (T(0) - T_end)
  [[nodiscard]] Temperatures closed_form(const Temperatures& T, double seconds) const {
    const Temperatures end = A.fullPivLu().solve(-b);
    const Eigen::EigenSolver<Eigen::Matrix2d> eigen(A);
    const Eigen::Vector2cd growth = (eigen.eigenvalues() * seconds).array().exp();
    const Eigen::Matrix2cd V = eigen.eigenvectors();
    const Eigen::Vector2cd away = (T - end).cast<std::complex<double>>();
    return end + (V * growth.asDiagonal() * V.inverse() * away).real();
  }
};

Ampere amperes(double value) {
  return Ampere::from_raw(static_cast<int32_t>(std::lround(std::ldexp(value, 28))));
}
double degrees(HeatSum temperature) { return std::ldexp(static_cast<double>(temperature.raw()), -40); }

void heat_for(MotorTemperatures& motor, double current, int ticks) {
  for (int i = 0; i < ticks; ++i) heat_up(motor, kRe25Heat, kAmbientFixed, amperes(current));
}

/// Seconds to the limit of 100 degC at a constant current from ambient; 0: not within at_most.
double seconds_to_limit(double current, int at_most) {
  MotorTemperatures motor = motor_at(kAmbientFixed);
  for (int second_1000 = 1; second_1000 <= at_most * 1000; ++second_1000) {
    heat_up(motor, kRe25Heat, kAmbientFixed, amperes(current));
    if (celsius(motor.winding) >= Celsius::ratio(100, 1)) return second_1000 * 1e-3;
  }
  return 0;
}

TEST(HeatOracle, AgreesWithItself) {
  for (const double current : {0.0, 1.24, 3.0, 5.5}) {
    const HeatFlow flow(current);
    Temperatures T(kAmbient, kAmbient);
    for (int i = 0; i < 1000; ++i) T = flow.runge_kutta(T, 0.01);
    const Temperatures exact = flow.closed_form({kAmbient, kAmbient}, 10);
    EXPECT_NEAR(T[0], exact[0], 1e-8);
    EXPECT_NEAR(T[1], exact[1], 1e-8);
  }
}

TEST(MotorHeat, FollowsTheClosedFormAtConstantCurrent) {
  for (const double current : {0.0, 0.05, 0.5, 1.24, -1.24, 2.0, 3.0, 5.5}) {
    const HeatFlow flow(current);
    MotorTemperatures motor = motor_at(kAmbientFixed);
    double seconds = 0;
    for (const int more : {1, 3, 26, 70}) {
      heat_for(motor, current, more * 1000);
      seconds += more;
      const Temperatures exact = flow.closed_form({kAmbient, kAmbient}, seconds);
      if (exact[0] > 200) break;
      const double tolerance = 1e-4 * (exact[0] - kAmbient) + 1e-6;
      EXPECT_NEAR(degrees(motor.winding), exact[0], tolerance) << current << " A, " << seconds << " s";
      EXPECT_NEAR(degrees(motor.housing), exact[1], tolerance) << current << " A, " << seconds << " s";
    }
  }
}

TEST(MotorHeat, CoolsDownAlongTheClosedForm) {
  const HeatFlow flow(0);
  MotorTemperatures motor{widen<40>(Celsius::ratio(100, 1)), widen<40>(Celsius::ratio(60, 1))};
  heat_for(motor, 0, 600000);
  const Temperatures exact = flow.closed_form({100, 60}, 600);
  EXPECT_NEAR(degrees(motor.winding), exact[0], 2e-3);
  EXPECT_NEAR(degrees(motor.housing), exact[1], 2e-3);
}

TEST(MotorHeat, FollowsRungeKuttaAtAnyCurrent) {
  Random random(3);
  MotorTemperatures motor = motor_at(kAmbientFixed);
  Temperatures T(kAmbient, kAmbient);
  double current = 0;
  double worst = 0;
  for (int tick = 0; tick < 300000; ++tick) {
    if (random.below(200) == 0) current = 2.0 * random.centred();
    const Ampere fixed = amperes(current);
    heat_up(motor, kRe25Heat, kAmbientFixed, fixed);
    T = HeatFlow(std::ldexp(static_cast<double>(fixed.raw()), -28)).runge_kutta(T, 1e-3);
    worst = std::max(worst, (T - Temperatures(degrees(motor.winding), degrees(motor.housing))).norm());
  }
  EXPECT_GT(T[1], 40);
  EXPECT_LT(worst, 0.005);
}

TEST(MotorHeat, ReachesItsLimitAfterThePublishedTimes) {
  EXPECT_NEAR(seconds_to_limit(5.5, 10), 4.6, 0.05);
  EXPECT_NEAR(seconds_to_limit(3.0, 60), 31, 0.5);
  EXPECT_NEAR(seconds_to_limit(2.0, 400), 240, 1);
}

TEST(MotorHeat, StaysBelowItsLimitAtTheContinuousCurrent) {
  MotorTemperatures motor = motor_at(kAmbientFixed);
  Celsius hottest = kAmbientFixed;
  for (int tick = 0; tick < 6000000; ++tick) {  // ten times the housing's time constant
    heat_up(motor, kRe25Heat, kAmbientFixed, amperes(1.24));
    if (celsius(motor.winding) > hottest) hottest = celsius(motor.winding);
  }
  EXPECT_LT(hottest, Celsius::ratio(100, 1));
  EXPECT_NEAR(degrees(motor.winding), 98, 1);
  const HeatFlow flow(1.24);
  const Temperatures end = flow.closed_form({kAmbient, kAmbient}, 6000);
  EXPECT_NEAR(degrees(motor.winding), end[0], 0.01);
  EXPECT_NEAR(degrees(motor.housing), end[1], 0.01);
}

TEST(MotorHeat, StaysAtAmbientWithoutCurrent) {
  MotorTemperatures motor = motor_at(kAmbientFixed);
  heat_for(motor, 0, 100000);
  EXPECT_EQ(motor.winding, widen<40>(kAmbientFixed));
  EXPECT_EQ(motor.housing, widen<40>(kAmbientFixed));
}

TEST(MotorHeat, StaysInItsFormatAtTheHighestCurrentForEver) {
  MotorTemperatures motor = motor_at(kAmbientFixed);
  for (const Ampere current : {Ampere::max(), Ampere::min()}) {
    HeatSum last = motor.winding;
    for (int tick = 0; tick < 1000000; ++tick) {
      heat_up(motor, kRe25Heat, kAmbientFixed, current);
      ASSERT_GE(motor.winding, last);
      last = motor.winding;
    }
  }
  EXPECT_EQ(celsius(motor.winding), Celsius::ratio(255, 1));
  EXPECT_LE(celsius(motor.housing), Celsius::ratio(255, 1));
}

TEST(MotorHeat, KnowsTheCurrentOfEveryCode) {
  const AmperesPerCode per_code = amperes_per_code(phantom::premium::kDriveRatings.full_scale_milliamperes);
  for (int32_t code = 0; code <= 4095; ++code) {
    const double exact = (code - 2048) * 5.5 / 2047;
    const Ampere current = current_of_code(static_cast<uint16_t>(code), per_code);
    ASSERT_NEAR(std::ldexp(static_cast<double>(current.raw()), -28), exact, 1e-8) << code;
  }
  EXPECT_EQ(current_of_code(2048, per_code), Ampere::from_raw(0));
}

}  // namespace
}  // namespace palpate::safety
