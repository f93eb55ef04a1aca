#include "palpate/numeric/reciprocal.hpp"

#include "palpate/numeric/high_word.hpp"

namespace palpate {
namespace {

using Offset = Q<-1, 32>;    // x less the middle of its domain
using Estimate = Q<3, 28>;   // the seed y
using Residual = Q<-9, 40>;  // r: how far the seed is off
using Correction = Q<-7, 38>;

/// c0 + u (c1 + u (c2 + ...)), unrolled.
template <std::size_t First = 0, std::size_t N>
PALPATE_ALWAYS_INLINE Estimate polynomial(const Estimate (&c)[N], Offset u) {
  if constexpr (First + 1 == N) {
    return c[First];
  } else {
    return multiply_add_high(u, polynomial<First + 1>(c, u), c[First]);
  }
}

/// The first bits of a seed that is above 0: Bits of them behind the point, so that products of it are exact.
template <int Bits>
uint32_t short_of(Estimate y) {
  return static_cast<uint32_t>(y.raw()) >> (Estimate::kFractionBits - Bits);
}

/// 1 - product, of a product of Bits fraction bits that is that near to 1.
template <int Bits>
Residual residual_of(uint64_t product) {
  return Residual::from_raw(-static_cast<int32_t>(product >> (Bits - Residual::kFractionBits)));
}

/// 2 itself becomes the largest number below it.
Q<1, 30> at_most_two(uint32_t raw) { return Q<1, 30>::from_raw(static_cast<int32_t>(raw - (raw >> 31))); }

}  // namespace

Q<1, 30> reciprocal_normalised(Q<0, 31> x) {
  check(x.raw() >= 1 << 30, "reciprocal_normalised needs x in [0.5, 1)");
  // In x - 3/4: within 3.0e-4, relative, and then cut by at most 2^-16.
  constexpr Estimate kSeed[] = {
      Estimate::from_raw(357913941),   //  1.33333333
      Estimate::from_raw(-475090049),  // -1.76984835
      Estimate::from_raw(633453398),   //  2.35979780
      Estimate::from_raw(-980831068),  // -3.65388046
      Estimate::from_raw(1307774758),  //  4.87184062
  };
  const uint32_t y = short_of<16>(polynomial(kSeed, Offset::from_raw((x.raw() - (3 << 29)) * 2)));
  const Residual r = residual_of<47>(uint64_t{static_cast<uint32_t>(x.raw())} * y);
  // y (1 + r + r^2)
  const auto one_more = Q<1, 30>::from_raw((1 << 30) + (r.raw() >> 10));
  const auto correction = multiply_high<Correction>(r, one_more);
  const auto more = multiply_high<Q<1, 30>>(Q<7, 24>::from_raw(static_cast<int32_t>(y << 8)), correction);
  return at_most_two((y << 14) + static_cast<uint32_t>(more.raw()));
}

Q<-1, 32> reciprocal_square_root_less_one(Q<1, 30> x) {
  check(x.raw() >= (1 << 29) - 256, "reciprocal_square_root_less_one needs x in [0.5, 2)");
  // In (x - 5/4) / 2: within 2.1e-4, relative, and then cut by at most 2^-14.5.
  constexpr Estimate kSeed[] = {
      Estimate::from_raw(240082472),    //  0.89437691
      Estimate::from_raw(-192920836),   // -0.71868612
      Estimate::from_raw(233498254),    //  0.86984878
      Estimate::from_raw(-262721062),   // -0.97871222
      Estimate::from_raw(329998744),    //  1.22934112
      Estimate::from_raw(-1166338958),  // -4.34495121
      Estimate::from_raw(1889919989),   //  7.04050060
  };
  const uint32_t y = short_of<15>(polynomial(kSeed, Offset::from_raw((x.raw() - (5 << 28)) * 2)));
  const uint32_t y_squared = y * y;
  const Residual r = residual_of<60>(uint64_t{static_cast<uint32_t>(x.raw())} * y_squared);
  // y (1 + r / 2 + 3/8 r^2)
  constexpr auto kThreeEighths = Q<8, 23>::from_raw(3 << 20);
  const auto half_and_more = multiply_add_high(r, kThreeEighths, Q<0, 31>::from_raw(1 << 30));
  const auto correction = multiply_high<Q<-8, 39>>(r, half_and_more);
  // Of 32 fraction bits a whole one leaves nothing, and the rest is below a half.
  const auto seed_less_one = Q<-1, 32>::from_raw(static_cast<int32_t>(y << 17));
  return multiply_add_high(Q<6, 25>::from_raw(static_cast<int32_t>(y << 10)), correction, seed_less_one);
}

Q<1, 30> reciprocal_square_root_normalised(Q<0, 31> x) {
  check(x.raw() >= 1 << 29, "reciprocal_square_root_normalised needs x in [0.25, 1)");
  constexpr auto kRootOfTwo = Q<1, 30>::ratio(14142135623730951, 10000000000000000);
  const auto less_one = reciprocal_square_root_less_one(Q<1, 30>::from_raw(x.raw()));  // of 2 x
  const auto more = multiply_high<Q<1, 30>>(less_one, kRootOfTwo);
  return at_most_two(static_cast<uint32_t>(kRootOfTwo.raw()) + static_cast<uint32_t>(more.raw()));
}

}  // namespace palpate
