#include "palpate/numeric/reciprocal.hpp"

namespace palpate {
namespace {

using Domain = Q<0, 31>;     // x
using Offset = Q<-1, 32>;    // x less the middle of its domain
using Estimate = Q<2, 29>;   // y, may be a little above 2 before the last step
using Residual = Q<-1, 32>;  // 1 - x y, or (1 - x y^2) / 2
using Result = Q<1, 30>;

constexpr auto kOne = widen<60>(Result::from_raw(1 << 30));

/// c0 + u c1 + u^2 c2 + u^3 c3, u = x - 3/4: within 1.8e-3 of 1/x, relative. 3 multiplies.
Estimate reciprocal_seed(Domain x) {
  constexpr auto kC0 = Estimate::from_raw(714587280);    //  1.33102253
  constexpr auto kC1 = Estimate::from_raw(-952783040);   // -1.77469671
  constexpr auto kC2 = Estimate::from_raw(1429174560);   //  2.66204506
  constexpr auto kC3 = Estimate::from_raw(-1905566080);  // -3.54939341
  const auto u = Offset::from_raw((x.raw() - (3 << 29)) * 2);
  const Estimate p2 = kC2 + narrow<Estimate>(u * kC3);
  const Estimate p1 = kC1 + narrow<Estimate>(u * p2);
  return kC0 + narrow<Estimate>(u * p1);
}

/// c0 + u c1 + u^2 c2 + u^3 c3 + u^4 c4, u = x - 5/8: within 2.2e-3 of 1/sqrt(x), relative. 4 multiplies.
Estimate reciprocal_square_root_seed(Domain x) {
  constexpr auto kC0 = Estimate::from_raw(679478320);    //  1.26562700
  constexpr auto kC1 = Estimate::from_raw(-525378517);   // -0.97859375
  constexpr auto kC2 = Estimate::from_raw(603509897);    //  1.12412478
  constexpr auto kC3 = Estimate::from_raw(-1321966935);  // -2.46235530
  constexpr auto kC4 = Estimate::from_raw(2042488023);   //  3.80443041
  const auto u = Offset::from_raw((x.raw() - (5 << 28)) * 2);
  const Estimate p3 = kC3 + narrow<Estimate>(u * kC4);
  const Estimate p2 = kC2 + narrow<Estimate>(u * p3);
  const Estimate p1 = kC1 + narrow<Estimate>(u * p2);
  return kC0 + narrow<Estimate>(u * p1);
}

/// y (1 + r), still as an accumulator. 1 multiply.
Acc<61> corrected(Estimate y, Residual r) { return widen<61>(y) + y * r; }

/// 1 - x y. 1 multiply.
Residual reciprocal_residual(Domain x, Estimate y) { return narrow<Residual>(kOne - x * y); }

/// (1 - x y^2) / 2, for y below 2. 2 multiplies.
Residual square_root_residual(Domain x, Estimate y) {
  const Estimate y_squared = narrow<Estimate>(y * y);
  return narrow<Residual>(divide_by_power_of_two<1>(kOne - x * y_squared));
}

/// The largest estimate whose square stays in its format. The true value is at most 2.
Estimate below_two(Estimate y) {
  constexpr auto kLimit = Estimate::from_raw((1 << 30) - 1);
  return y > kLimit ? kLimit : y;
}

}  // namespace

Q<1, 30> reciprocal_normalised(Q<0, 31> x) {
  check(x.raw() >= 1 << 30, "reciprocal_normalised needs x in [0.5, 1)");
  const Estimate y0 = reciprocal_seed(x);
  const Estimate y1 = narrow<Estimate>(corrected(y0, reciprocal_residual(x, y0)));
  return narrow_saturated<Result>(corrected(y1, reciprocal_residual(x, y1)));
}

Q<1, 30> reciprocal_square_root_normalised(Q<0, 31> x) {
  check(x.raw() >= 1 << 29, "reciprocal_square_root_normalised needs x in [0.25, 1)");
  const Estimate y0 = below_two(reciprocal_square_root_seed(x));
  const Estimate y1 = below_two(narrow<Estimate>(corrected(y0, square_root_residual(x, y0))));
  return narrow_saturated<Result>(corrected(y1, square_root_residual(x, y1)));
}

}  // namespace palpate
