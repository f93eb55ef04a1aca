// Angles as fractions of a turn, and their sine and cosine.
#pragma once

#include "palpate/numeric/q.hpp"

namespace palpate {

/// Binary angle: raw / 2^32 turns, so that raw runs over [-1/2, 1/2) turn and arithmetic wraps as angles do.
/// One LSB is 1.46e-9 rad.
class Angle {
 public:
  Angle() = default;
  static constexpr Angle from_raw(int32_t raw) {
    Angle angle{};
    angle.raw_ = raw;
    return angle;
  }
  /// numerator / denominator turns, rounded to nearest, for compile-time constants (degrees: n / 360).
  /// Needs denominator > 0 and |numerator / denominator| < 1/2.
  static constexpr Angle of_turn(int64_t numerator, int64_t denominator) {
    return from_raw(Q<-1, 32>::ratio(numerator, denominator).raw());
  }
  [[nodiscard]] constexpr int32_t raw() const { return raw_; }

  friend constexpr Angle operator+(Angle a, Angle b) { return from_bits(a.bits() + b.bits()); }
  friend constexpr Angle operator-(Angle a, Angle b) { return from_bits(a.bits() - b.bits()); }
  constexpr Angle operator-() const { return from_bits(0u - bits()); }

  friend constexpr bool operator==(Angle a, Angle b) { return a.raw_ == b.raw_; }
  friend constexpr bool operator!=(Angle a, Angle b) { return a.raw_ != b.raw_; }

 private:
  [[nodiscard]] constexpr uint32_t bits() const { return static_cast<uint32_t>(raw_); }
  static constexpr Angle from_bits(uint32_t bits) { return from_raw(static_cast<int32_t>(bits)); }

  int32_t raw_;
};

/// Both in [-1, 1]; 0 and +-1 are exact at multiples of a quarter turn.
struct SineCosine {
  Q<1, 30> sine, cosine;
};

/// Sine and cosine together. The angle is reduced to +-1/8 turn about the nearest multiple of a quarter turn,
/// where both are minimax polynomials (Remez exchange; sine of degree 9, error 1.7e-12; cosine of degree 8,
/// error 5.4e-11); the quarter then swaps and negates by selects.
/// Error at most 1 LSB (2^-30) each. Cost: 10 multiplies (32 x 32 to 64), no loop.
SineCosine sine_cosine(Angle angle);

}  // namespace palpate
