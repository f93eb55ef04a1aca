// Fixed-point numbers: Q<I, F> is a 32-bit signed number with F fraction bits, value = raw / 2^F,
// range [-2^I, 2^I). I + F = 31 and I may be negative: Q<-5, 36> has a range of +-1/32.
//
//   Q + Q, Q - Q    same format only, 32-bit
//   Q * Q           exact, a 64-bit Acc that knows its fraction bits
//   narrow<To>(acc) the only way back: a shift, rounded to nearest (ties up)
//
// Nothing converts implicitly; from_raw and ratio are the only ways in. In the release build sums wrap
// (two's complement, no undefined behaviour); docs/numerics.md shows why none does. The checked build
// stops at the first operation that leaves its range.
#pragma once

#include "palpate/numeric/check.hpp"
#include "palpate/numeric/platform.hpp"

namespace palpate {

template <class>
inline constexpr bool kAlwaysFalse = false;

/// 64-bit accumulator with F fraction bits: value = raw / 2^F.
template <int F>
class Acc {
 public:
  static constexpr int kFractionBits = F;

  Acc() = default;
  /// Only for Eigen, which writes the empty sum as Scalar(0).
  constexpr explicit Acc(int zero) : raw_(0) { check(zero == 0, "Acc(int) takes 0 only; use from_raw"); }
  static constexpr Acc from_raw(int64_t raw) {
    Acc acc{};
    acc.raw_ = raw;
    return acc;
  }
  [[nodiscard]] constexpr int64_t raw() const { return raw_; }

  friend constexpr Acc operator+(Acc a, Acc b) {
    int64_t sum = 0;
    const bool overflow = __builtin_add_overflow(a.raw_, b.raw_, &sum);
    check(!overflow, "Acc sum leaves 64 bits");
    return from_raw(sum);
  }
  friend constexpr Acc operator-(Acc a, Acc b) {
    int64_t difference = 0;
    const bool overflow = __builtin_sub_overflow(a.raw_, b.raw_, &difference);
    check(!overflow, "Acc difference leaves 64 bits");
    return from_raw(difference);
  }
  constexpr Acc operator-() const { return from_raw(0) - *this; }
  constexpr Acc& operator+=(Acc other) { return *this = *this + other; }
  constexpr Acc& operator-=(Acc other) { return *this = *this - other; }

  friend constexpr bool operator==(Acc a, Acc b) { return a.raw_ == b.raw_; }
  friend constexpr bool operator!=(Acc a, Acc b) { return a.raw_ != b.raw_; }
  friend constexpr bool operator<(Acc a, Acc b) { return a.raw_ < b.raw_; }
  friend constexpr bool operator>(Acc a, Acc b) { return a.raw_ > b.raw_; }
  friend constexpr bool operator<=(Acc a, Acc b) { return a.raw_ <= b.raw_; }
  friend constexpr bool operator>=(Acc a, Acc b) { return a.raw_ >= b.raw_; }

 private:
  int64_t raw_;
};

/// 32-bit fixed-point number, see the head of this file.
template <int I, int F>
class Q {
  static_assert(I + F == 31, "palpate: Q<I, F> has 32 bits, so I + F must be 31");

 public:
  static constexpr int kIntegerBits = I;
  static constexpr int kFractionBits = F;

  Q() = default;
  template <class Number, std::enable_if_t<std::is_arithmetic_v<Number>, int> = 0>
  constexpr Q(Number) {  // NOLINT(google-explicit-constructor): it exists to refuse with our message
    static_assert(kAlwaysFalse<Number>, "palpate: numbers do not become Q; use from_raw, ratio or narrow");
  }
  template <int F2>
  constexpr Q(Acc<F2>) {  // NOLINT(google-explicit-constructor): it exists to refuse with our message
    static_assert(kAlwaysFalse<Acc<F2>>, "palpate: an Acc does not become a Q by itself; use narrow");
  }
  static constexpr Q from_raw(int32_t raw) {
    Q q{};
    q.raw_ = raw;
    return q;
  }
  /// numerator / denominator rounded to nearest, for compile-time constants (it loops over the bits).
  /// Needs denominator > 0 and |numerator| < 2^62.
  static constexpr Q ratio(int64_t numerator, int64_t denominator);
  static constexpr Q max() { return from_raw(std::numeric_limits<int32_t>::max()); }
  static constexpr Q min() { return from_raw(std::numeric_limits<int32_t>::min()); }
  [[nodiscard]] constexpr int32_t raw() const { return raw_; }

  friend constexpr Q operator+(Q a, Q b) {
    int32_t sum = 0;
    const bool overflow = __builtin_add_overflow(a.raw_, b.raw_, &sum);
    check(!overflow, "Q sum leaves 32 bits");
    return from_raw(sum);
  }
  friend constexpr Q operator-(Q a, Q b) {
    int32_t difference = 0;
    const bool overflow = __builtin_sub_overflow(a.raw_, b.raw_, &difference);
    check(!overflow, "Q difference leaves 32 bits");
    return from_raw(difference);
  }
  constexpr Q operator-() const { return from_raw(0) - *this; }
  constexpr Q& operator+=(Q other) { return *this = *this + other; }
  constexpr Q& operator-=(Q other) { return *this = *this - other; }

  template <int I2, int F2>
  friend constexpr Acc<F + F2> operator*(Q a, Q<I2, F2> b) {
    return Acc<F + F2>::from_raw(static_cast<int64_t>(a.raw()) * b.raw());
  }

  friend constexpr bool operator==(Q a, Q b) { return a.raw_ == b.raw_; }
  friend constexpr bool operator!=(Q a, Q b) { return a.raw_ != b.raw_; }
  friend constexpr bool operator<(Q a, Q b) { return a.raw_ < b.raw_; }
  friend constexpr bool operator>(Q a, Q b) { return a.raw_ > b.raw_; }
  friend constexpr bool operator<=(Q a, Q b) { return a.raw_ <= b.raw_; }
  friend constexpr bool operator>=(Q a, Q b) { return a.raw_ >= b.raw_; }

 private:
  int32_t raw_;
};

template <int I, int F>
constexpr Q<I, F> Q<I, F>::ratio(int64_t numerator, int64_t denominator) {
  uint64_t rest = static_cast<uint64_t>(numerator < 0 ? -numerator : numerator);
  const auto divisor = static_cast<uint64_t>(denominator);
  uint64_t quotient = rest / divisor;
  rest %= divisor;
  for (int bit = 0; bit < F; ++bit) {
    rest *= 2;
    quotient = 2 * quotient + (rest >= divisor ? 1 : 0);
    rest -= rest >= divisor ? divisor : 0;
  }
  quotient += 2 * rest >= divisor ? 1 : 0;
  check(quotient <= 0x7fffffffu, "ratio leaves the format");
  return from_raw(
      static_cast<int32_t>(numerator < 0 ? -static_cast<int64_t>(quotient) : static_cast<int64_t>(quotient)));
}

// Mixed formats and bare numbers: refused with a message that says what to do.
template <int I1, int F1, int I2, int F2, std::enable_if_t<F1 != F2, int> = 0>
constexpr Q<I1, F1> operator+(Q<I1, F1> a, Q<I2, F2>) {
  static_assert(F1 == F2, "palpate: Q + Q needs one format; narrow one side first");
  return a;
}
template <int I1, int F1, int I2, int F2, std::enable_if_t<F1 != F2, int> = 0>
constexpr Q<I1, F1> operator-(Q<I1, F1> a, Q<I2, F2>) {
  static_assert(F1 == F2, "palpate: Q - Q needs one format; narrow one side first");
  return a;
}
template <int F1, int F2, std::enable_if_t<F1 != F2, int> = 0>
constexpr Acc<F1> operator+(Acc<F1> a, Acc<F2>) {
  static_assert(F1 == F2, "palpate: Acc + Acc needs equal fraction bits");
  return a;
}
template <int F1, int F2, std::enable_if_t<F1 != F2, int> = 0>
constexpr Acc<F1> operator-(Acc<F1> a, Acc<F2>) {
  static_assert(F1 == F2, "palpate: Acc - Acc needs equal fraction bits");
  return a;
}

/// raw >> shift, rounded to nearest (ties up). 1 <= shift <= 62.
constexpr int64_t shift_right_rounded(int64_t raw, int shift) { return ((raw >> (shift - 1)) + 1) >> 1; }

namespace narrow_detail {

/// The lower 32 bits of raw >> Shift, rounded to nearest.
template <int Shift>
constexpr uint32_t rounded_down(uint64_t raw) {
  if constexpr (Shift == 0) {
    return static_cast<uint32_t>(raw);
  } else if constexpr (Shift == 32) {
    // Two instructions, the second of which is an addition of a shifted register.
    return static_cast<uint32_t>(raw >> 32) + (static_cast<uint32_t>(raw) >> 31);
  } else {
    const uint64_t rounded = raw + (uint64_t{1} << (Shift - 1));
    // Up to 32 a logical shift gives the same bits as an arithmetic one; gcc then sees that only 32 of them
    // are left and multiplies them as such.
    return Shift <= 32 ? static_cast<uint32_t>(rounded >> Shift)
                       : static_cast<uint32_t>(static_cast<int64_t>(rounded) >> Shift);
  }
}

}  // namespace narrow_detail

/// The way back from 64 bits: a shift, rounded to nearest. The caller knows that the value fits.
template <class To, int F>
constexpr To narrow(Acc<F> acc) {
  constexpr int kShift = F - To::kFractionBits;
  static_assert(kShift >= 0, "palpate: narrow only drops fraction bits; widen the factors instead");
  const auto low =
      static_cast<int32_t>(narrow_detail::rounded_down<kShift>(static_cast<uint64_t>(acc.raw())));
  check(low == (kShift == 0 ? acc.raw() : shift_right_rounded(acc.raw(), kShift)), "narrow leaves 32 bits");
  return To::from_raw(low);
}

/// narrow for values that may leave To: they become its nearest limit.
template <class To, int F>
constexpr To narrow_saturated(Acc<F> acc) {
  constexpr int kShift = F - To::kFractionBits;
  static_assert(kShift >= 0, "palpate: narrow only drops fraction bits; widen the factors instead");
  int64_t rounded = acc.raw();
  if constexpr (kShift > 0) rounded = shift_right_rounded(rounded, kShift);
  if (rounded > std::numeric_limits<int32_t>::max()) return To::max();
  if (rounded < std::numeric_limits<int32_t>::min()) return To::min();
  return To::from_raw(static_cast<int32_t>(rounded));
}

/// A Q as an accumulator with F fraction bits (exact). F is at least the format's own.
template <int F, int I2, int F2>
constexpr Acc<F> widen(Q<I2, F2> q) {
  static_assert(F >= F2 && F - F2 <= 32, "palpate: widen adds fraction bits, at most 32");
  return Acc<F>::from_raw(static_cast<int64_t>(q.raw()) * (int64_t{1} << (F - F2)));
}

/// value / 2^N, exactly: the same bits, read with N more fraction bits.
template <int N, int F>
constexpr Acc<F + N> divide_by_power_of_two(Acc<F> acc) {
  return Acc<F + N>::from_raw(acc.raw());
}

template <int I, int F>
constexpr Q<I, F> clamp(Q<I, F> value, Q<I, F> low, Q<I, F> high) {
  const Q<I, F> at_least_low = value < low ? low : value;
  return at_least_low > high ? high : at_least_low;
}

/// value for 0, -value for -1: without a branch.
template <int I, int F>
constexpr Q<I, F> with_sign(int32_t minus, Q<I, F> value) {
  return Q<I, F>::from_raw((value.raw() ^ minus) - minus);
}

template <int I, int F>
constexpr Q<I, F> abs(Q<I, F> value) {
  return value < Q<I, F>::from_raw(0) ? -value : value;
}

}  // namespace palpate
