// The ramp rises along a line, never by a step, and only from a free hand.
#include "palpate/safety/force_ramp.hpp"

#include <gtest/gtest.h>

#include "every.hpp"
#include "support/random.hpp"

namespace palpate::safety {
namespace {

using phantom::Newton;
using test::just_below;
using Random = palpate::test::Random;

constexpr RampParameters kDefaults{};
constexpr Newton kZero = Newton::from_raw(0);

Vector3<Newton> along_x(Newton force) { return {force, kZero, kZero}; }
Vector3<Newton> no_force() { return along_x(kZero); }
Vector3<Newton> contact() { return along_x(kDefaults.contact_newtons); }

RampParameters with_ticks(uint16_t ramp_ticks) {
  RampParameters parameters;
  parameters.step_per_tick = ramp_step(ramp_ticks);
  return parameters;
}

void advance_free(ForceRamp& ramp, const RampParameters& parameters, int ticks) {
  for (int i = 0; i < ticks; ++i) (void)advance(ramp, parameters, true, no_force());
}

TEST(ForceRamp, RisesFromExactlyNothingToExactlyEverything) {
  for (const int32_t ticks : {1, 2, 3, 7, 1000, 1024, 2000, 32767}) {
    const RampParameters parameters = with_ticks(static_cast<uint16_t>(ticks));
    ForceRamp ramp = make_force_ramp();
    EXPECT_EQ(ramp.gain, kNoForce);
    advance_free(ramp, parameters, parameters.free_ticks - 1);
    EXPECT_EQ(ramp.gain, kNoForce);
    int32_t taken = 0;
    Gain last = kNoForce;
    while (ramp.gain != kFullForce && taken < 40000) {
      const Gain gain = advance(ramp, parameters, true, no_force());
      ASSERT_GT(gain, last);
      ASSERT_LE(int64_t{gain.raw() - last.raw()} * ticks, kFullForce.raw());
      last = gain;
      ++taken;
    }
    EXPECT_EQ(ramp.gain.raw(), 1 << 30);
    EXPECT_EQ(taken, ticks + ((1 << 30) % ticks == 0 ? 0 : 1));
    advance_free(ramp, parameters, 10);
    EXPECT_EQ(ramp.gain, kFullForce);
  }
}

TEST(ForceRamp, TakesTwoSecondsByDefault) {
  ForceRamp ramp = make_force_ramp();
  advance_free(ramp, kDefaults, 3 + 1000);
  EXPECT_NEAR(ramp.gain.raw(), 1 << 29, 1000);  // half way after a second
  advance_free(ramp, kDefaults, 1000);
  EXPECT_LT(ramp.gain, kFullForce);
  advance_free(ramp, kDefaults, 1);
  EXPECT_EQ(ramp.gain, kFullForce);
}

TEST(ForceRamp, WithoutTicksGivesTheWholeForceAtOnce) {
  RampParameters parameters = with_ticks(0);
  parameters.free_ticks = 0;
  ForceRamp ramp = make_force_ramp();
  EXPECT_EQ(advance(ramp, parameters, true, contact()), kFullForce);
}

TEST(ForceRamp, WaitsForAFreeHandForMoreThanThreeTicks) {
  ForceRamp ramp = make_force_ramp();
  for (int i = 0; i < 5000; ++i) ASSERT_EQ(advance(ramp, kDefaults, true, contact()), kNoForce);
  for (int repeat = 0; repeat < 5; ++repeat) {  // three free ticks are not enough, and don't add up
    for (int i = 0; i < 3; ++i) ASSERT_EQ(advance(ramp, kDefaults, true, no_force()), kNoForce);
    ASSERT_EQ(advance(ramp, kDefaults, true, contact()), kNoForce);
  }
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(advance(ramp, kDefaults, true, along_x(just_below(kDefaults.contact_newtons))), kNoForce);
  }
  EXPECT_EQ(advance(ramp, kDefaults, true, no_force()), kDefaults.step_per_tick);
}

TEST(ForceRamp, MeasuresTheWholeForceForContact) {
  // 0.1201 N along each axis is 0.208 N.
  const Newton each = Newton::ratio(1201, 10000);
  ForceRamp ramp = make_force_ramp();
  for (int i = 0; i < 10; ++i) EXPECT_EQ(advance(ramp, kDefaults, true, {each, each, each}), kNoForce);
  const Newton lowest = Newton::min();
  EXPECT_EQ(advance(ramp, kDefaults, true, {lowest, lowest, lowest}), kNoForce);
}

TEST(ForceRamp, GoesOnThroughContactOnceBegun) {
  ForceRamp ramp = make_force_ramp();
  advance_free(ramp, kDefaults, 100);
  const Gain before = ramp.gain;
  EXPECT_EQ(advance(ramp, kDefaults, true, contact()), before + kDefaults.step_per_tick);
}

TEST(ForceRamp, FallsToExactlyNothingAtOnceAndBeginsAnew) {
  for (const int ticks : {0, 3, 4, 500, 3000}) {
    ForceRamp ramp = make_force_ramp();
    advance_free(ramp, kDefaults, ticks);
    EXPECT_EQ(advance(ramp, kDefaults, false, no_force()), kNoForce);
    advance_free(ramp, kDefaults, 3);
    EXPECT_EQ(ramp.gain, kNoForce);
    advance_free(ramp, kDefaults, 1);
    EXPECT_EQ(ramp.gain, kDefaults.step_per_tick);
  }
}

TEST(ForceRamp, ScalesExactlyAtItsEnds) {
  Random random(7);
  for (int i = 0; i < 10000; ++i) {
    const auto component = [&random] { return Newton::from_raw(static_cast<int32_t>(random.bits() >> 32)); };
    const Newton x = component();
    const Newton y = component();
    const Vector3<Newton> force(x, y, Newton::min());
    EXPECT_EQ(scaled(kFullForce, force), force);
    EXPECT_EQ(scaled(kNoForce, force), zero_vector<Newton>());
    const Gain gain = Gain::from_raw(static_cast<int32_t>(random.below(1u << 30)));
    const double exact = std::ldexp(static_cast<double>(gain.raw()), -30) * x.raw();
    EXPECT_NEAR(scaled(gain, force).x().raw(), exact, 0.5);
  }
}

}  // namespace
}  // namespace palpate::safety
