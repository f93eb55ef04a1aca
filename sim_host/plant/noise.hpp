// Random numbers whose bits depend on the seed alone, on any machine.
#pragma once

#include <cmath>
#include <cstdint>

namespace palpate::plant {

/// SplitMix64 (Steele, Lea, Flood 2014). The standard library's engines are portable, its distributions are
/// not.
class Noise {
 public:
  explicit Noise(uint64_t seed) : state_(seed) {}

  uint64_t bits() {
    state_ += 0x9e3779b97f4a7c15u;
    uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  /// [0, 1), a multiple of 2^-53.
  double unit() { return std::ldexp(static_cast<double>(bits() >> 11), -53); }
  /// Nearly normal, mean 0, variance 1, within +-6: the sum of twelve units, since a logarithm's last bit is
  /// the library's matter.
  double normal() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += unit();
    return sum;
  }

 private:
  uint64_t state_;
};

}  // namespace palpate::plant
