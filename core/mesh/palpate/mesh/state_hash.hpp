// A 64-bit hash over 32-bit words (FNV-1a's step, a word at a time): the same on every machine, order
// matters. For states, golden files and divergence logs; not for the cycle.
#pragma once

#include "palpate/numeric/bounded.hpp"
#include "palpate/numeric/linear.hpp"

namespace palpate {

class StateHash {
 public:
  /// A word for up to 32 bits, two for 64, the low one first.
  template <class Word, std::enable_if_t<std::is_unsigned_v<Word>, int> = 0>
  void add(Word word) {
    add_word(static_cast<uint32_t>(word));
    if constexpr (sizeof(Word) == sizeof(uint64_t)) add_word(static_cast<uint32_t>(word >> 32));
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
  void add_word(uint32_t word) { value_ = (value_ ^ word) * kPrime; }

  static constexpr uint64_t kPrime = 0x100000001b3;
  uint64_t value_ = 0xcbf29ce484222325;
};

}  // namespace palpate
