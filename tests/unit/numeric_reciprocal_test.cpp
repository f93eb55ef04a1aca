#include "palpate/numeric/reciprocal.hpp"

#include <gtest/gtest.h>

#include "sweep.hpp"

namespace palpate {
namespace {

using test::sweep;
using test::WorstError;

constexpr int64_t kHalf = int64_t{1} << 30;
constexpr int64_t kQuarter = int64_t{1} << 29;
constexpr int64_t kBelowOne = (int64_t{1} << 31) - 1;

double exact_raw(double result) { return std::ldexp(result, 30); }

double reciprocal_error(int32_t raw) {
  const double x = std::ldexp(static_cast<double>(raw), -31);
  return reciprocal_normalised(Q<0, 31>::from_raw(raw)).raw() - exact_raw(1 / x);
}

double reciprocal_square_root_error(int32_t raw) {
  const double x = std::ldexp(static_cast<double>(raw), -31);
  return reciprocal_square_root_normalised(Q<0, 31>::from_raw(raw)).raw() - exact_raw(1 / std::sqrt(x));
}

TEST(LeadingZeros, CountsAboveTheHighestBit) {
  for (int bit = 0; bit < 32; ++bit) {
    EXPECT_EQ(leading_zeros(uint32_t{1} << bit), 31 - bit);
    EXPECT_EQ(leading_zeros(0xffffffffu >> (31 - bit)), 31 - bit);
  }
}

TEST(Reciprocal, SaturatesAtAHalf) {
  EXPECT_EQ(reciprocal_normalised(Q<0, 31>::from_raw(kHalf)), (Q<1, 30>::max()));
}

TEST(Reciprocal, StaysWithinItsErrorBound) {
  WorstError worst;
  sweep(kHalf + 1, kBelowOne, 509, [&](int32_t raw) { worst.see(reciprocal_error(raw), raw); });
  RecordProperty("worst_lsb", std::to_string(worst.error));
  EXPECT_LE(worst.error, 0.6) << "at raw " << worst.at;
}

TEST(Reciprocal, StaysWithinItsErrorBoundAtBothEnds) {
  for (int32_t step = 1; step < 5000; ++step) {
    EXPECT_LE(std::fabs(reciprocal_error(static_cast<int32_t>(kHalf) + step)), 0.6) << step;
    EXPECT_LE(std::fabs(reciprocal_error(static_cast<int32_t>(kBelowOne) - step)), 0.6) << step;
  }
}

TEST(ReciprocalSquareRoot, SaturatesAtAQuarter) {
  EXPECT_EQ(reciprocal_square_root_normalised(Q<0, 31>::from_raw(kQuarter)), (Q<1, 30>::max()));
}

TEST(ReciprocalSquareRoot, StaysWithinItsErrorBound) {
  WorstError worst;
  sweep(kQuarter, kBelowOne, 509, [&](int32_t raw) { worst.see(reciprocal_square_root_error(raw), raw); });
  RecordProperty("worst_lsb", std::to_string(worst.error));
  EXPECT_LE(worst.error, 1.0) << "at raw " << worst.at;
}

TEST(ReciprocalSquareRoot, StaysWithinItsErrorBoundAtBothEnds) {
  for (int32_t step = 0; step < 5000; ++step) {
    EXPECT_LE(std::fabs(reciprocal_square_root_error(static_cast<int32_t>(kQuarter) + step)), 1.0) << step;
    EXPECT_LE(std::fabs(reciprocal_square_root_error(static_cast<int32_t>(kBelowOne) - step)), 1.0) << step;
  }
}

double less_one_error(int32_t raw) {
  const double x = std::ldexp(static_cast<double>(raw), -30);
  return reciprocal_square_root_less_one(Q<1, 30>::from_raw(raw)).raw() -
         std::ldexp(1 / std::sqrt(x) - 1, 32);
}

TEST(ReciprocalSquareRootLessOne, StaysWithinItsErrorBound) {
  WorstError worst;
  sweep(kQuarter - 256, kBelowOne, 509, [&](int32_t raw) { worst.see(less_one_error(raw), raw); });
  RecordProperty("worst_lsb", std::to_string(worst.error));
  EXPECT_LE(worst.error, 1.0) << "at raw " << worst.at;
}

/// Around 1, where |q|^2 of most quaternions is, and at both ends.
TEST(ReciprocalSquareRootLessOne, StaysWithinItsErrorBoundWhereItMatters) {
  constexpr auto kOne = static_cast<int32_t>(kHalf);
  EXPECT_EQ(reciprocal_square_root_less_one(Q<1, 30>::from_raw(kOne)).raw(), 0);
  for (int32_t step = 0; step < 5000; ++step) {
    EXPECT_LE(std::fabs(less_one_error(kOne + step)), 1.0) << step;
    EXPECT_LE(std::fabs(less_one_error(kOne - step)), 1.0) << step;
    EXPECT_LE(std::fabs(less_one_error(static_cast<int32_t>(kQuarter) + step)), 1.0) << step;
    EXPECT_LE(std::fabs(less_one_error(static_cast<int32_t>(kBelowOne) - step)), 1.0) << step;
  }
}

#ifdef PALPATE_CHECKED
TEST(ReciprocalDeathTest, RefusesInputsOutsideItsDomain) {
  EXPECT_DEATH(static_cast<void>(reciprocal_normalised(Q<0, 31>::from_raw(kHalf - 1))), "0.5, 1");
  EXPECT_DEATH(static_cast<void>(reciprocal_square_root_normalised(Q<0, 31>::from_raw(kQuarter - 1))),
               "0.25");
  EXPECT_DEATH(static_cast<void>(leading_zeros(0)), "leading_zeros of 0");
}
#endif

}  // namespace
}  // namespace palpate
