// The portable twins of the target's instructions; that both have the same bits the golden hashes show.
#include "palpate/numeric/high_word.hpp"

#include <gtest/gtest.h>

#include "palpate/numeric/clamp_flag.hpp"
#include "support/random.hpp"

namespace palpate {
namespace {

using Factor = Q<1, 30>;
using Length = Q<4, 27>;
using Product = Q<6, 25>;

int32_t any_raw(test::Random& random) {
  return static_cast<int32_t>(static_cast<uint32_t>(random.bits())) >> random.below(24);
}

TEST(HighWord, IsTheProductRoundedToNearest) {
  test::Random random(11);
  for (int i = 0; i < 100000; ++i) {
    const auto a = Factor::from_raw(any_raw(random));
    const auto b = Length::from_raw(any_raw(random));
    EXPECT_EQ(multiply_high<Product>(a, b), narrow<Product>(a * b));
    const auto sum = Product::from_raw(any_raw(random) / 4);
    EXPECT_EQ(multiply_add_high(a, b, sum), sum + narrow<Product>(a * b));
  }
}

TEST(HighWord, RoundsTiesUp) {
  const auto half_lsb = [](int32_t sign) {
    return multiply_high<Product>(Factor::from_raw(1 << 16), Length::from_raw(sign * (1 << 15))).raw();
  };
  EXPECT_EQ(half_lsb(1), 1);
  EXPECT_EQ(half_lsb(-1), 0);
}

TEST(ClampFlag, ClampsToAPowerOfTwoAndRemembers) {
  ClampFlag clamped;
  EXPECT_FALSE(clamped.take());
  EXPECT_EQ(clamped.clamp<8>(Length::from_raw(127)).raw(), 127);
  EXPECT_EQ(clamped.clamp<8>(Length::from_raw(-128)).raw(), -128);
  EXPECT_FALSE(clamped.take());
  EXPECT_EQ(clamped.clamp<8>(Length::from_raw(128)).raw(), 127);
  EXPECT_EQ(clamped.clamp<8>(Length::from_raw(5)).raw(), 5);
  EXPECT_TRUE(clamped.take());
  EXPECT_FALSE(clamped.take());
  EXPECT_EQ(clamped.clamp<31>(Length::min()).raw(), -(1 << 30));
  EXPECT_TRUE(clamped.take());
}

}  // namespace
}  // namespace palpate
