#include <gtest/gtest.h>

#include "palpate/solve/dynamics.hpp"
#include "support/random.hpp"
#include "units.hpp"

namespace palpate::test {
namespace {

Dynamics dynamics_of(double impulse_times_mass) {
  int exponent = 0;
  const double mantissa = std::frexp(impulse_times_mass, &exponent);
  Dynamics dynamics{};
  dynamics.impulse_mantissa = sim::to_fixed<Q<0, 31>>(mantissa);
  dynamics.impulse_exponent = static_cast<int8_t>(exponent);
  return dynamics;
}

/// Within half an LSB of 2^-28 and 2^-29 of the value (the reciprocal's 0.8 of 2^-30, and the mantissa's cut
/// bit).
TEST(Impulse, IsKOverMass) {
  Random random(91);
  double worst = 0.0;
  for (int i = 0; i < 200000; ++i) {
    const auto mass = static_cast<MassUnits>(std::exp2(4.0 + 27.9 * random.unit()));
    const double impulse = 7.9 * std::exp2(-14.0 * random.unit());
    const Dynamics dynamics = dynamics_of(impulse * mass);
    const double exact =
        std::ldexp(sim::to_double(dynamics.impulse_mantissa), dynamics.impulse_exponent) / mass;
    const double error = std::abs(sim::to_double(impulse_of(dynamics, mass)) - exact);
    const double bound = std::ldexp(0.5, -28) + exact * std::ldexp(1.0, -29);
    worst = std::max(worst, error / bound);
    ASSERT_LE(error, bound) << mass << " " << impulse;
  }
  EXPECT_GT(worst, 0.5);
}

TEST(Impulse, OfPowersOfTwoIsExactButForSaturation) {
  for (int bit = 0; bit < 32; ++bit) {
    const Dynamics dynamics = dynamics_of(std::exp2(bit));
    const double impulse = sim::to_double(impulse_of(dynamics, MassUnits{1} << bit));
    EXPECT_NEAR(impulse, 1.0, std::ldexp(1.0, -28));
  }
}

TEST(RigidMotion, IdentityKeepsEveryRestPosition) {
  const RigidMotion identity = RigidMotion::identity();
  for (int16_t x = -64; x <= 64; ++x) {
    const LatticePoint at{x, static_cast<int16_t>(-x), 7};
    EXPECT_EQ(identity(at), rest_position(at));
  }
}

}  // namespace
}  // namespace palpate::test
