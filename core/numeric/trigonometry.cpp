#include "palpate/numeric/trigonometry.hpp"

namespace palpate {
namespace {

// Coefficients in z = t^2, t = angle / (1/8 turn). Each format has two fraction bits more than the one
// before, so that every product's high word is the next sum's term.
constexpr auto kS0 = Q<0, 31>::from_raw(1686629713);   //  0.785398163378806
constexpr auto kS1 = Q<-2, 33>::from_raw(-693598665);  // -0.0807455118151601
constexpr auto kS2 = Q<-4, 35>::from_raw(85569234);    //  0.00249039247884483
constexpr auto kS3 = Q<-6, 37>::from_raw(-5026337);    // -3.65714176657445e-5
constexpr auto kS4 = Q<-8, 39>::from_raw(169635);      //  3.08563416622944e-7

constexpr auto kC1 = Q<-1, 32>::from_raw(1324675872);  //  0.308425135838372
constexpr auto kC2 = Q<-3, 34>::from_raw(-272375277);  // -0.0158543277518783
constexpr auto kC3 = Q<-5, 36>::from_raw(22398564);    //  3.25942007951294e-4
constexpr auto kC4 = Q<-7, 38>::from_raw(-970686);     // -3.53133465585556e-6

/// sin(pi/4 t) = t (S0 + z (S1 + z (S2 + z (S3 + z S4)))), |t| <= 1. 5 multiplies.
Q<1, 30> sine_of_octant(Q<0, 31> t, Q<1, 30> z) {
  const Q<-6, 37> p3 = kS3 + narrow<Q<-6, 37>>(z * kS4);
  const Q<-4, 35> p2 = kS2 + narrow<Q<-4, 35>>(z * p3);
  const Q<-2, 33> p1 = kS1 + narrow<Q<-2, 33>>(z * p2);
  const Q<0, 31> p0 = kS0 + narrow<Q<0, 31>>(z * p1);
  return narrow<Q<1, 30>>(t * p0);
}

/// cos(pi/4 t) = 1 - z (C1 + z (C2 + z (C3 + z C4))), |t| <= 1. 4 multiplies.
Q<1, 30> cosine_of_octant(Q<1, 30> z) {
  const Q<-5, 36> p3 = kC3 + narrow<Q<-5, 36>>(z * kC4);
  const Q<-3, 34> p2 = kC2 + narrow<Q<-3, 34>>(z * p3);
  const Q<-1, 32> p1 = kC1 + narrow<Q<-1, 32>>(z * p2);
  return Q<1, 30>::from_raw(1 << 30) - narrow<Q<1, 30>>(z * p1);
}

}  // namespace

SineCosine sine_cosine(Angle angle) {
  const auto bits = static_cast<uint32_t>(angle.raw());
  const uint32_t quarter = (bits + 0x20000000u) >> 30;
  // The distance to that quarter, in units of 1/8 turn: the shift drops the quarters.
  const auto t = Q<0, 31>::from_raw(static_cast<int32_t>(bits << 2));
  const Q<1, 30> z = narrow<Q<1, 30>>(t * t);
  const Q<1, 30> sine = sine_of_octant(t, z);
  const Q<1, 30> cosine = cosine_of_octant(z);
  const bool swapped = (quarter & 1u) != 0;
  const Q<1, 30> a = swapped ? cosine : sine;
  const Q<1, 30> b = swapped ? sine : cosine;
  return {(quarter & 2u) != 0 ? -a : a, ((quarter + 1u) & 2u) != 0 ? -b : b};
}

}  // namespace palpate
