// What an observing force evaluation gathers over the leaves of a group: the volume mean of A = R^T F, and
// the sums of its misfit. From the rows of a leaf (leaf_force.hpp), with c_jk h^-1 = s_j B_jk and A = S B
// S^T:
//   A[axis j][axis k] = s_k c_jk / h,
//   A[axis j][axis k] - A[axis k][axis j] = s_k (c_jk - s_j s_k c_kj) / h.
#pragma once

#include "palpate/elastic/misfit.hpp"
#include "palpate/numeric/high_word.hpp"

namespace palpate {

/// The edge vectors of a leaf, row by row, with the axis and the sign (-1 for minus, else 0) of each row.
struct LeafRows {
  Position c[3][3];
  uint32_t axis[3];
  int32_t minus[3];
};

/// `mask` is 0, or -1 for minus.
template <class Fixed>
PALPATE_ALWAYS_INLINE Fixed with_sign(int32_t mask, Fixed value) {
  return Fixed::from_raw((value.raw() ^ mask) - mask);
}

class Observation {
 public:
  Observation() {
    for (const uint32_t i : bounded<9>(9, [] {})) mean_.data()[i] = Strain::from_raw(0);
  }

  /// A leaf with h = 2^-size, `depth` levels below the group's tet; `path` as in Leaf. Once in the code for
  /// leaves of all levels. Some 185 instructions.
  PALPATE_NOINLINE void add(const LeafRows& leaf, int size, uint32_t path, uint32_t depth) {
    add_gradient(leaf, size, depth);
    if (depth > 0) misfit_.add(turn_of(leaf, size), path, depth);
  }

  [[nodiscard]] const Matrix3<Strain>& mean() const { return mean_; }
  [[nodiscard]] const MisfitSums& misfit() const { return misfit_; }

 private:
  void add_gradient(const LeafRows& leaf, int size, uint32_t depth) {
    // 2^-depth, and for a group of one leaf the largest below 1
    const uint32_t power = 0x80000000u >> depth;
    const auto weight = Q<0, 31>::from_raw(static_cast<int32_t>(power - (power >> 31)));
    add_column<0>(leaf, size, weight);
    add_column<1>(leaf, size, weight);
    add_column<2>(leaf, size, weight);
  }
  template <int K>
  PALPATE_ALWAYS_INLINE void add_column(const LeafRows& leaf, int size, Q<0, 31> weight) {
    Strain* column = mean_.data() + std::size_t{3} * leaf.axis[K];
    const Q<0, 31> signed_weight = with_sign(leaf.minus[K], weight);
    add_entry(leaf.c[0][K], size, signed_weight, column[leaf.axis[0]]);
    add_entry(leaf.c[1][K], size, signed_weight, column[leaf.axis[1]]);
    add_entry(leaf.c[2][K], size, signed_weight, column[leaf.axis[2]]);
  }
  PALPATE_ALWAYS_INLINE static void add_entry(Position c, int size, Q<0, 31> weight, Strain& sum) {
    using Twice = Q<3, 28>;  // |A| <= 4
    sum = multiply_add_high(Twice::from_raw(c.raw() * (2 << size)), weight, sum);
  }

  /// (A32 - A23, A13 - A31, A21 - A12). Of rows j < k the third axis has a minus where j, k and it are in
  /// order.
  static Vector3<Strain> turn_of(const LeafRows& leaf, int size) {
    const int32_t in_order = is_even_order(leaf.axis[0], leaf.axis[1]) ? -1 : 0;
    Vector3<Strain> turn;
    const auto set = [&](uint32_t j, uint32_t k, uint32_t third, int32_t sign) {
      const Position other = with_sign(leaf.minus[j] ^ leaf.minus[k], leaf.c[k][j]);
      const auto difference = Strain::from_raw((leaf.c[j][k] - other).raw() * (1 << size));
      turn.data()[leaf.axis[third]] = with_sign(leaf.minus[k] ^ sign, difference);
    };
    set(0, 1, 2, in_order);
    set(0, 2, 1, ~in_order);
    set(1, 2, 0, in_order);
    return turn;
  }

  Matrix3<Strain> mean_;
  MisfitSums misfit_;
};

}  // namespace palpate
