// A 64-bit hash over 32-bit words (FNV-1a's step, a word at a time): the same on every machine, order
// matters. For states, golden files and divergence logs; not for the cycle.
#pragma once

#include "palpate/numeric/bounded.hpp"
#include "palpate/numeric/linear.hpp"

namespace palpate {

class StateHash {
 public:
  void add(uint32_t word) { value_ = (value_ ^ word) * kPrime; }
  void add(uint16_t half) { add(uint32_t{half}); }
  void add(uint64_t words) {
    add(static_cast<uint32_t>(words));
    add(static_cast<uint32_t>(words >> 32));
  }
  template <int I, int F>
  void add(Q<I, F> q) {
    add(static_cast<uint32_t>(q.raw()));
  }
  template <class Scalar, int Rows, int Cols>
  void add(const Eigen::Matrix<Scalar, Rows, Cols>& matrix) {
    for (const uint32_t i : bounded<Rows * Cols>(Rows * Cols, [] {})) add(matrix.data()[i]);
  }
  [[nodiscard]] uint64_t value() const { return value_; }

 private:
  static constexpr uint64_t kPrime = 0x100000001b3;
  uint64_t value_ = 0xcbf29ce484222325;
};

}  // namespace palpate
