#include "palpate/numeric/q.hpp"

#include <gtest/gtest.h>

#include <random>

#include "palpate/numeric/linear.hpp"
#include "sweep.hpp"

namespace palpate {
namespace {

using Unit = Q<0, 31>;
using Wide = Q<4, 27>;
constexpr int32_t kMax = std::numeric_limits<int32_t>::max();
constexpr int32_t kMin = std::numeric_limits<int32_t>::min();

/// round(raw / 2^shift), ties up, in exact integers.
int64_t rounded(int64_t raw, int shift) {
  const int64_t unit = int64_t{1} << shift;
  int64_t quotient = raw / unit;
  int64_t rest = raw % unit;
  if (rest < 0) {
    rest += unit;
    --quotient;
  }
  return quotient + (2 * rest >= unit ? 1 : 0);
}

TEST(Q, HasTheSizeOfItsRaw) {
  static_assert(sizeof(Unit) == 4 && sizeof(Acc<62>) == 8);
  static_assert(std::is_trivially_copyable_v<Unit> && std::is_trivially_default_constructible_v<Unit>);
  static_assert(std::is_trivially_copyable_v<Acc<62>>);
  EXPECT_EQ(Unit::from_raw(-5).raw(), -5);
  EXPECT_EQ(Unit::max().raw(), kMax);
  EXPECT_EQ(Unit::min().raw(), kMin);
}

TEST(Q, AddsAndSubtractsExactly) {
  constexpr Wide kA = Wide::from_raw(1000);
  constexpr Wide kB = Wide::from_raw(-7);
  static_assert((kA + kB).raw() == 993 && (kA - kB).raw() == 1007 && (-kA).raw() == -1000);
  Wide c = kA;
  c += kB;
  EXPECT_EQ(c.raw(), 993);
  c -= kB;
  EXPECT_EQ(c, kA);
  EXPECT_LT(kB, kA);
  EXPECT_LE(kA, kA);
  EXPECT_GT(kA, kB);
  EXPECT_GE(kA, kA);
  EXPECT_NE(kA, kB);
}

#ifdef PALPATE_CHECKED
TEST(QDeathTest, CheckedBuildStopsAtTheFirstOverflow) {
  EXPECT_DEATH(static_cast<void>(Unit::max() + Unit::from_raw(1)), "Q sum leaves 32 bits");
  EXPECT_DEATH(static_cast<void>(Unit::min() - Unit::from_raw(1)), "Q difference leaves 32 bits");
  EXPECT_DEATH(static_cast<void>(-Unit::min()), "Q difference leaves 32 bits");
  const auto top = Acc<10>::from_raw(std::numeric_limits<int64_t>::max());
  EXPECT_DEATH(static_cast<void>(top + Acc<10>::from_raw(1)), "Acc sum leaves 64 bits");
  EXPECT_DEATH(static_cast<void>(-top - top), "Acc difference leaves 64 bits");
  EXPECT_DEATH(static_cast<void>(narrow<Unit>(Acc<32>::from_raw(int64_t{1} << 32))), "narrow leaves 32 bits");
}
#else
TEST(Q, WrapsWithoutUndefinedBehaviour) {
  EXPECT_EQ((Unit::max() + Unit::from_raw(1)).raw(), kMin);
  EXPECT_EQ((Unit::min() - Unit::from_raw(1)).raw(), kMax);
  EXPECT_EQ((-Unit::min()).raw(), kMin);
  const auto top = Acc<10>::from_raw(std::numeric_limits<int64_t>::max());
  EXPECT_EQ((top + Acc<10>::from_raw(1)).raw(), std::numeric_limits<int64_t>::min());
}
#endif

TEST(Q, MultipliesExactly) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 10000; ++i) {
    const auto a = static_cast<int32_t>(random());
    const auto b = static_cast<int32_t>(random());
    const auto product = Unit::from_raw(a) * Wide::from_raw(b);
    static_assert(std::is_same_v<decltype(product), const Acc<58>>);
    ASSERT_EQ(product.raw(), static_cast<int64_t>(a) * b);
  }
  EXPECT_EQ((Unit::min() * Unit::min()).raw(), int64_t{1} << 62);
}

TEST(Q, RatioRoundsToNearest) {
  static_assert(Unit::ratio(1, 2).raw() == 1 << 30);
  static_assert(Unit::ratio(-1, 3).raw() == -715827883 && Unit::ratio(1, 3).raw() == 715827883);
  static_assert(Q<31, 0>::ratio(7, 2).raw() == 4 && Q<31, 0>::ratio(-7, 2).raw() == -4);
  static_assert(Q<-5, 36>::ratio(1, 64).raw() == 1 << 30);
  static_assert(Q<4, 27>::ratio(15, 1).raw() == 15 << 27);
  std::mt19937_64 random(2);
  for (int i = 0; i < 1000; ++i) {
    const auto denominator = static_cast<int64_t>(random() % 1000000000) + 1;
    const auto numerator = static_cast<int64_t>(random() % 2000000000) - 1000000000;
    if (std::llabs(numerator) >= denominator) continue;
    const double exact = std::ldexp(static_cast<double>(numerator) / static_cast<double>(denominator), 31);
    ASSERT_LE(std::fabs(Unit::ratio(numerator, denominator).raw() - exact), 0.5 + 1e-6);
  }
}

TEST(Narrow, RoundsToNearestTiesUp) {
  using Whole = Q<31, 0>;
  const int64_t raws[] = {-12, -11, -10, -9, -8, -7, -6, -5, -4, -3, -2, -1,
                          0,   1,   2,   3,  4,  5,  6,  7,  8,  9,  10};
  const int32_t expected[] = {-3, -3, -2, -2, -2, -2, -1, -1, -1, -1, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3};
  for (std::size_t i = 0; i < std::size(raws); ++i) {
    EXPECT_EQ(narrow<Whole>(Acc<2>::from_raw(raws[i])).raw(), expected[i]) << raws[i];
    EXPECT_EQ(narrow_saturated<Whole>(Acc<2>::from_raw(raws[i])).raw(), expected[i]) << raws[i];
    EXPECT_EQ(shift_right_rounded(raws[i], 2), expected[i]) << raws[i];
  }
}

TEST(Narrow, AgreesWithExactRounding) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 10000; ++i) {
    const auto raw = static_cast<int64_t>(random()) >> 2;
    ASSERT_EQ(narrow<Wide>(Acc<59>::from_raw(raw)).raw(), rounded(raw, 32));
    ASSERT_EQ(narrow<Unit>(Acc<31 + 31>::from_raw(raw)).raw(), rounded(raw, 31));
    ASSERT_EQ(narrow<Unit>(Acc<31>::from_raw(raw >> 31)).raw(), raw >> 31);
  }
}

TEST(Narrow, KeepsTheSignWhenItDropsMoreThan32Bits) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 10000; ++i) {
    const auto raw = static_cast<int64_t>(random()) >> 1;
    ASSERT_EQ((narrow<Q<4, 27>>(Acc<67>::from_raw(raw)).raw()), rounded(raw, 40));
  }
}

TEST(Narrow, SaturatesAtTheLimits) {
  const auto top = Acc<41>::from_raw(int64_t{kMax} << 10);
  EXPECT_EQ(narrow_saturated<Unit>(top), Unit::max());
  EXPECT_EQ(narrow_saturated<Unit>(top + Acc<41>::from_raw(511)), Unit::max());
  EXPECT_EQ(narrow_saturated<Unit>(top + Acc<41>::from_raw(512)), Unit::max());
  const auto bottom = Acc<41>::from_raw(int64_t{kMin} * 1024);
  EXPECT_EQ(narrow_saturated<Unit>(bottom), Unit::min());
  EXPECT_EQ(narrow_saturated<Unit>(bottom - Acc<41>::from_raw(100000)), Unit::min());
  EXPECT_EQ(narrow_saturated<Unit>(Acc<41>::from_raw(std::numeric_limits<int64_t>::max())), Unit::max());
  EXPECT_EQ(narrow_saturated<Unit>(Acc<41>::from_raw(std::numeric_limits<int64_t>::min())), Unit::min());
  EXPECT_EQ(narrow_saturated<Unit>(Acc<31>::from_raw(int64_t{kMax} + 1)), Unit::max());
}

TEST(Widen, IsExactAndNarrowUndoesIt) {
  for (const int32_t raw : {kMin, -1, 0, 1, 12345, kMax}) {
    EXPECT_EQ(widen<63>(Unit::from_raw(raw)).raw(), static_cast<int64_t>(raw) * (int64_t{1} << 32));
    EXPECT_EQ(widen<31>(Unit::from_raw(raw)).raw(), raw);
    EXPECT_EQ(narrow<Wide>(widen<50>(Wide::from_raw(raw))).raw(), raw);
  }
}

TEST(DivideByPowerOfTwo, KeepsTheBits) {
  const auto half = divide_by_power_of_two<1>(Acc<40>::from_raw(-7));
  static_assert(std::is_same_v<decltype(half), const Acc<41>>);
  EXPECT_EQ(half.raw(), -7);
}

TEST(Clamp, KeepsBetweenItsLimits) {
  const auto clamped = [](int32_t raw) {
    return clamp(Wide::from_raw(raw), Wide::from_raw(-10), Wide::from_raw(20)).raw();
  };
  EXPECT_EQ(clamped(kMin), -10);
  EXPECT_EQ(clamped(-10), -10);
  EXPECT_EQ(clamped(3), 3);
  EXPECT_EQ(clamped(21), 20);
  EXPECT_EQ(abs(Wide::from_raw(-3)).raw(), 3);
  EXPECT_EQ(abs(Wide::from_raw(3)).raw(), 3);
}

TEST(Linear, ProductsAreExactSums) {
  std::mt19937_64 random(4);
  const auto draw = [&random] { return static_cast<int32_t>(random()) >> 2; };
  for (int i = 0; i < 200; ++i) {
    Matrix3<Q<1, 30>> matrix;
    Matrix3<Q<1, 30>> other;
    Vector3<Wide> vector;
    for (Eigen::Index k = 0; k < 9; ++k) matrix(k) = Q<1, 30>::from_raw(draw());
    for (Eigen::Index k = 0; k < 9; ++k) other(k) = Q<1, 30>::from_raw(draw());
    for (Eigen::Index k = 0; k < 3; ++k) vector(k) = Wide::from_raw(draw());
    const Vector3<Wide> image = narrow<Wide>(matrix * vector);
    const Matrix3<Q<2, 29>> product = narrow<Q<2, 29>>(matrix * other);
    for (Eigen::Index row = 0; row < 3; ++row) {
      int64_t sum = 0;
      for (Eigen::Index k = 0; k < 3; ++k) sum += (matrix(row, k) * vector(k)).raw();
      ASSERT_EQ(image(row).raw(), rounded(sum, 30));
      int64_t entry = 0;
      for (Eigen::Index k = 0; k < 3; ++k) entry += (matrix(row, k) * other(k, 1)).raw();
      ASSERT_EQ(product(row, 1).raw(), rounded(entry, 31));
    }
  }
}

TEST(Linear, SumsTransposesAndZero) {
  const Vector3<Wide> a(Wide::from_raw(1), Wide::from_raw(2), Wide::from_raw(3));
  const Vector3<Wide> sum = a + a - zero_vector<Wide>();
  EXPECT_EQ(sum.z().raw(), 6);
  const Acc<54> dot = (a.transpose() * a)(0, 0);
  EXPECT_EQ(dot.raw(), 14);
  EXPECT_EQ(Vector3<Wide>(-a).x().raw(), -1);
}

}  // namespace
}  // namespace palpate
