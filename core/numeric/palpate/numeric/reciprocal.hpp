// 1/x and 1/sqrt(x) of a normalised number: a polynomial seed, cut to some 16 bits so that the residual of it
// is exact, and one step of third order. No division, no loop, no table; the steps are the same for every x.
// A caller shifts its number into the domain with leading_zeros and shifts the result back: 1/(x 2^n) = (1/x)
// 2^-n, 1/sqrt(x 4^n) = (1/sqrt(x)) 2^-n.
//
// The seeds are minimax in the relative error (Remez exchange). The step cubes the relative error d of the
// seed: d -> d^3 for the reciprocal, d -> 2.5 d^3 for the square root.
#pragma once

#include "palpate/numeric/q.hpp"

namespace palpate {

/// Number of zero bits above the highest set bit, 0..31. x must not be 0. One instruction (clz).
constexpr int leading_zeros(uint32_t x) {
  check(x != 0, "leading_zeros of 0");
  return __builtin_clz(x);
}

/// 1/x for x in [0.5, 1): a number in (1, 2]; 2 itself, from x = 0.5 alone, saturates to Q<1, 30>::max().
/// Error at most 0.6 LSB (2^-30; 1 LSB where it saturates): 0.5 from the last rounding, 0.07 from the method
/// (quartic seed 3.2e-4 with its cut, then 3.2e-11). Cost: 7 multiplies.
Q<1, 30> reciprocal_normalised(Q<0, 31> x);

/// 1/sqrt(x) for x in [0.25, 1): a number in (1, 2]; 2 itself saturates to Q<1, 30>::max().
/// Error at most 1 LSB (2^-30): 0.5 from the last rounding and 1.42 times the error below. Cost: 12
/// multiplies.
Q<1, 30> reciprocal_square_root_normalised(Q<0, 31> x);

/// 1/sqrt(x) - 1 for x in [0.5, 2), or below by 2^-22: what is to be added of v for v/sqrt(x). Error at most
/// 2^-32: half of it from the last rounding, a sixth from the method (seed of degree 6, 2.5e-4 with its cut,
/// then 3.9e-11). Cost: 11 multiplies.
Q<-1, 32> reciprocal_square_root_less_one(Q<1, 30> x);

}  // namespace palpate
