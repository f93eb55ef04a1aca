#include "palpate/numeric/trigonometry.hpp"

#include <gtest/gtest.h>

#include "sweep.hpp"

namespace palpate {
namespace {

using test::sweep;
using test::WorstError;

constexpr int32_t kOne = 1 << 30;
constexpr double kRadiansPerRaw = 2 * 3.14159265358979323846 / 4294967296.0;

void see_errors(int32_t raw, WorstError& sine, WorstError& cosine) {
  const SineCosine result = sine_cosine(Angle::from_raw(raw));
  const double angle = raw * kRadiansPerRaw;
  sine.see(result.sine.raw() - std::ldexp(std::sin(angle), 30), raw);
  cosine.see(result.cosine.raw() - std::ldexp(std::cos(angle), 30), raw);
}

TEST(Angle, WrapsAtHalfATurn) {
  constexpr Angle kLast = Angle::from_raw(std::numeric_limits<int32_t>::max());
  constexpr Angle kFirst = Angle::from_raw(std::numeric_limits<int32_t>::min());
  EXPECT_EQ(kLast + Angle::from_raw(1), kFirst);
  EXPECT_EQ(kFirst - Angle::from_raw(1), kLast);
  EXPECT_EQ(-kFirst, kFirst);
  EXPECT_EQ(-kLast, Angle::from_raw(-std::numeric_limits<int32_t>::max()));
  EXPECT_NE(kLast, kFirst);
}

TEST(Angle, OfTurnRoundsToNearest) {
  EXPECT_EQ(Angle::of_turn(1, 4).raw(), 1 << 30);
  EXPECT_EQ(Angle::of_turn(-90, 360).raw(), -(1 << 30));
  EXPECT_EQ(Angle::of_turn(1, 3).raw(), 1431655765);
  EXPECT_EQ(Angle::of_turn(-1, 3).raw(), -1431655765);
}

TEST(SineCosine, IsExactAtQuarterTurns) {
  const int32_t expected[4][2] = {{0, kOne}, {kOne, 0}, {0, -kOne}, {-kOne, 0}};
  for (uint32_t quarter = 0; quarter < 4; ++quarter) {
    const SineCosine result = sine_cosine(Angle::from_raw(static_cast<int32_t>(quarter << 30)));
    EXPECT_EQ(result.sine.raw(), expected[quarter][0]);
    EXPECT_EQ(result.cosine.raw(), expected[quarter][1]);
  }
}

TEST(SineCosine, StaysWithinItsErrorBound) {
  WorstError sine;
  WorstError cosine;
  sweep(std::numeric_limits<int32_t>::min(), std::numeric_limits<int32_t>::max(), 2039,
        [&](int32_t raw) { see_errors(raw, sine, cosine); });
  RecordProperty("worst_sine_lsb", std::to_string(sine.error));
  RecordProperty("worst_cosine_lsb", std::to_string(cosine.error));
  EXPECT_LE(sine.error, 0.9) << "at raw " << sine.at;
  EXPECT_LE(cosine.error, 0.9) << "at raw " << cosine.at;
}

TEST(SineCosine, StaysWithinItsErrorBoundWhereOctantsMeet) {
  WorstError sine;
  WorstError cosine;
  for (uint32_t octant = 0; octant < 8; ++octant) {
    for (uint32_t step = 0; step < 4000; ++step) {
      see_errors(static_cast<int32_t>((octant << 29) + step - 2000), sine, cosine);
    }
  }
  EXPECT_LE(sine.error, 0.9) << "at raw " << sine.at;
  EXPECT_LE(cosine.error, 0.9) << "at raw " << cosine.at;
}

TEST(SineCosine, TurnsByAQuarterToTheBit) {
  sweep(std::numeric_limits<int32_t>::min(), std::numeric_limits<int32_t>::max(), 65521, [](int32_t raw) {
    const Angle angle = Angle::from_raw(raw);
    const SineCosine here = sine_cosine(angle);
    const SineCosine quarter_on = sine_cosine(angle + Angle::from_raw(kOne));
    ASSERT_EQ(quarter_on.sine, here.cosine) << raw;
    ASSERT_EQ(quarter_on.cosine, -here.sine) << raw;
    // Ties round up and an octant owns its lower end, so mirror images may differ by one.
    const SineCosine mirrored = sine_cosine(-angle);
    ASSERT_LE(std::abs(mirrored.cosine.raw() - here.cosine.raw()), 1) << raw;
    ASSERT_LE(std::abs(mirrored.sine.raw() + here.sine.raw()), 1) << raw;
  });
}

}  // namespace
}  // namespace palpate
