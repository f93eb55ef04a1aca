// 1/x and 1/sqrt(x) of a normalised number: a polynomial seed, then two Newton steps. No division, no loop,
// no table; the steps are the same for every x. A caller shifts its number into the domain with leading_zeros
// and shifts the result back: 1/(x 2^n) = (1/x) 2^-n, 1/sqrt(x 4^n) = (1/sqrt(x)) 2^-n.
//
// The seeds are minimax in the relative error (Remez exchange, coefficients rounded to 2^-29). Newton squares
// the relative error d of the step before: d -> -d^2 for the reciprocal, d -> -1.5 d^2 for the square root.
#pragma once

#include "palpate/numeric/q.hpp"

namespace palpate {

/// Number of zero bits above the highest set bit, 0..31. x must not be 0. One instruction (clz).
constexpr int leading_zeros(uint32_t x) {
  check(x != 0, "leading_zeros of 0");
  return __builtin_clz(x);
}

/// 1/x for x in [0.5, 1): a number in (1, 2]; 2 itself, from x = 0.5 alone, saturates to Q<1, 30>::max().
/// Error at most 0.8 LSB (2^-30; 1 LSB where it saturates): 0.5 from the last rounding, 0.25 from the
/// residual's, 0.02 from the method (cubic seed 1.8e-3, then 3.1e-6, 9.1e-12).
/// Cost: 7 multiplies (32 x 32 to 64).
Q<1, 30> reciprocal_normalised(Q<0, 31> x);

/// 1/sqrt(x) for x in [0.25, 1): a number in (1, 2]; 2 itself saturates to Q<1, 30>::max().
/// Error at most 1.2 LSB (2^-30): 0.5 from the last rounding, up to 0.5 from y^2, 0.25 from the residual's
/// rounding, 0.15 from the method (quartic seed 2.2e-3, then 6.8e-6, 6.9e-11).
/// Cost: 10 multiplies (32 x 32 to 64).
Q<1, 30> reciprocal_square_root_normalised(Q<0, 31> x);

}  // namespace palpate
