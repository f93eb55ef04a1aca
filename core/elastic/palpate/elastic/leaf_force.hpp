// The corotated force of one leaf in its group's frame, in the hot loop's form. With the leaf's signed axes
// as a signed permutation S (tet_shape.hpp), B = S^T A S has the rows
//   B_jk = s_j (g_k)[axis j] / h,
// so axes are addresses and signs belong to rows. The isotropic law commutes with S, and row j of the stress
// gives component axis j of all three edge forces, with the sign s_j again. Off the diagonal only s_j s_k
// matters, and it is applied twice.
//
// Nothing is scaled by h: with c_jk = (g_k)[axis j] and t the type, an edge's force is sigma h^2 / 2^t, so
//   s_j sigma_jk h^2 / 2^t = mu h / 2^t (c_jk + s_j s_k c_kj),
// and the coefficients carry the powers of two. Code of its own for each level has them as constants.
#pragma once

#include "palpate/elastic/element_force.hpp"
#include "palpate/numeric/clamp_flag.hpp"
#include "palpate/numeric/high_word.hpp"

namespace palpate {

namespace leaf_force_detail {

/// `mask` is 0, or -1 for minus.
template <class Fixed>
PALPATE_ALWAYS_INLINE Fixed with_sign(int32_t mask, Fixed value) {
  return Fixed::from_raw((value.raw() ^ mask) - mask);
}

/// A from c, once in the code for leaves of all levels.
PALPATE_NOINLINE inline Matrix3<Strain> gradient_of(const Position (&c)[3][3], const uint32_t (&axis)[3],
                                                    const int32_t (&minus)[3], int size) {
  Matrix3<Strain> a;
  for (const uint32_t i : bounded<9>(9, [] {})) {
    const uint32_t row = i / 3;
    const uint32_t column = i % 3;
    const auto scaled = Strain::from_raw(c[row][column].raw() * (1 << size));
    a.data()[axis[row] + 3 * axis[column]] = with_sign(minus[column], scaled);
  }
  return a;
}

}  // namespace leaf_force_detail

template <uint8_t Level>
class LeafForce {
 public:
  PALPATE_ALWAYS_INLINE explicit LeafForce(Axes axes)
      : axis_{axes.axis(0), axes.axis(1), axes.axis(2)},
        minus_{axes.is_negative(0) ? -1 : 0, axes.is_negative(1) ? -1 : 0, axes.is_negative(2) ? -1 : 0} {}

  /// The edge vectors, from the positions of the four nodes in the group's frame: within +-4 edges.
  PALPATE_ALWAYS_INLINE void gather(const Vector3<Position>& w0, const Vector3<Position>& w1,
                                    const Vector3<Position>& w2, const Vector3<Position>& w3,
                                    ClampFlag& clamped) {
    gather_row<0>(w0, w1, w2, w3, clamped);
    gather_row<1>(w0, w1, w2, w3, clamped);
    gather_row<2>(w0, w1, w2, w3, clamped);
  }

  /// A = S B S^T.
  [[nodiscard]] Matrix3<Strain> gradient() const {
    return leaf_force_detail::gradient_of(c_, axis_, minus_, kSize);
  }

  /// Adds the nodal forces. 7 multiplies.
  PALPATE_ALWAYS_INLINE void scatter(const Material& material, Vector3<Force>& f0, Vector3<Force>& f1,
                                     Vector3<Force>& f2, Vector3<Force>& f3, ClampFlag& clamped) const {
    Force t[3][3];
    edge_forces(material, t, clamped);
    scatter_row<0>(t[0], f0, f1, f2, f3);
    scatter_row<1>(t[1], f0, f1, f2, f3);
    scatter_row<2>(t[2], f0, f1, f2, f3);
  }

 private:
  static constexpr TetType kType = type_of_level(Level);
  static constexpr int kSize = size_of_level(Level);
  static constexpr int kTypeBits = static_cast<int>(kType);
  static constexpr Position kEdge =
      Position::from_raw((int32_t{1} << Position::kFractionBits) >> kSize);  // h
  /// Of +-kStretchLimit h, +-kTraceLimit h and +-kStressLimit h^2 / 2^t.
  static constexpr int kStretchBits = 30 - kSize;
  static constexpr int kTraceBits = 29 - kSize;
  static constexpr int kForceBits = 25 - 2 * kSize - kTypeBits;
  static_assert(kStretchLimit == 4 && kTraceLimit.raw() == (int32_t{1} << 28) - 1 &&
                    kStressLimit == Stress::ratio(1, 2),
                "palpate: the limits are powers of two");

  template <int Row>
  PALPATE_ALWAYS_INLINE void gather_row(const Vector3<Position>& w0, const Vector3<Position>& w1,
                                        const Vector3<Position>& w2, const Vector3<Position>& w3,
                                        ClampFlag& clamped) {
    const Position x0 = w0.data()[axis_[Row]];
    const Position x1 = w1.data()[axis_[Row]];
    const Position x2 = w2.data()[axis_[Row]];
    const Position x3 = w3.data()[axis_[Row]];
    const Position g2 = kType == TetType::kType2 ? (x2 - x0) + (x2 - x1) : x2 - x1;
    const Position g3 = kType == TetType::kType0   ? x3 - x2
                        : kType == TetType::kType1 ? (x3 - x0) + (x3 - x2)
                                                   : (x3 - x2) + (x3 - x2);
    c_[Row][0] = clamped.clamp<kStretchBits>(x1 - x0);
    c_[Row][1] = clamped.clamp<kStretchBits>(g2);
    c_[Row][2] = clamped.clamp<kStretchBits>(g3);
  }

  /// mu h / 2^t, at most 1/12.
  PALPATE_ALWAYS_INLINE static Q<1, 30> shear(const Material& material) {
    static_assert(ShearCoefficient::kFractionBits == 31);
    return Q<1, 30>::from_raw(material.shear.raw() >> (1 + kSize + kTypeBits));
  }
  /// lambda h / 2^t.
  PALPATE_ALWAYS_INLINE static BulkCoefficient bulk(const Material& material) {
    return BulkCoefficient::from_raw(material.bulk.raw() >> (kSize + kTypeBits));
  }

  /// t_jk, component axis j of the force that pulls at g_k.
  PALPATE_ALWAYS_INLINE void edge_forces(const Material& material, Force (&t)[3][3],
                                         ClampFlag& clamped) const {
    const Q<1, 30> mu = shear(material);
    const Position stretch[3] = {leaf_force_detail::with_sign(minus_[0], c_[0][0]),
                                 leaf_force_detail::with_sign(minus_[1], c_[1][1]),
                                 leaf_force_detail::with_sign(minus_[2], c_[2][2])};
    const Position trace =
        clamped.clamp<kTraceBits>(stretch[0] + stretch[1] + stretch[2] - (kEdge + kEdge + kEdge));
    const Force pressure = multiply_high<Force>(bulk(material), Q<2, 29>::from_raw(trace.raw() * 4));
    const auto normal = [&](int j) {
      const Position twice_strain = stretch[j] + stretch[j] - (kEdge + kEdge);
      t[j][j] = leaf_force_detail::with_sign(
          minus_[j], clamped.clamp<kForceBits>(multiply_add_high(mu, twice_strain, pressure)));
    };
    const auto tangential = [&](int j, int k) {
      const int32_t minus = minus_[j] ^ minus_[k];
      const Position twice_strain = c_[j][k] + leaf_force_detail::with_sign(minus, c_[k][j]);
      t[j][k] = clamped.clamp<kForceBits>(multiply_high<Force>(mu, twice_strain));
      t[k][j] = leaf_force_detail::with_sign(minus, t[j][k]);
    };
    normal(0);
    normal(1);
    normal(2);
    tangential(0, 1);
    tangential(0, 2);
    tangential(1, 2);
  }

  template <int Row>
  PALPATE_ALWAYS_INLINE void scatter_row(const Force (&t)[3], Vector3<Force>& f0, Vector3<Force>& f1,
                                         Vector3<Force>& f2, Vector3<Force>& f3) const {
    const auto& [t1, t2, t3] = t;
    f0.data()[axis_[Row]] += kType == TetType::kType0 ? t1 : kType == TetType::kType1 ? t1 + t3 : t1 + t2;
    f1.data()[axis_[Row]] += t2 - t1;
    f2.data()[axis_[Row]] += kType == TetType::kType2 ? (t3 - t2) + (t3 - t2) : t3 - t2;
    f3.data()[axis_[Row]] -= kType == TetType::kType0 ? t3 : t3 + t3;
  }

  uint32_t axis_[3];
  int32_t minus_[3];
  Position c_[3][3];
};

}  // namespace palpate
