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

/// The edge vectors of a leaf, row by row, with the axis and the sign (-1 for minus, else 0) of each row.
struct LeafRows {
  Position c[3][3];
  uint32_t axis[3];
  int32_t minus[3];
};

template <uint8_t Level>
class LeafForce {
 public:
  PALPATE_ALWAYS_INLINE explicit LeafForce(Axes axes)
      : rows_{{},
              {axes.axis(0), axes.axis(1), axes.axis(2)},
              {axes.is_negative(0) ? -1 : 0, axes.is_negative(1) ? -1 : 0, axes.is_negative(2) ? -1 : 0}} {}

  /// The edge vectors, from the positions of the four nodes in the group's frame: within +-4 edges.
  PALPATE_ALWAYS_INLINE void gather(const Vector3<Position>& w0, const Vector3<Position>& w1,
                                    const Vector3<Position>& w2, const Vector3<Position>& w3,
                                    ClampFlag& clamped) {
    gather_row<0>(w0, w1, w2, w3, clamped);
    gather_row<1>(w0, w1, w2, w3, clamped);
    gather_row<2>(w0, w1, w2, w3, clamped);
  }

  /// Adds 2^-depth A to a mean of A = R^T F. From the rows, A[axis j][axis k] = s_k c_jk / h.
  PALPATE_ALWAYS_INLINE void add_gradient(uint32_t depth, Matrix3<Strain>& mean) const {
    // For a group of one leaf the largest below 1.
    const uint32_t power = 0x80000000u >> depth;
    const auto weight = Q<0, 31>::from_raw(static_cast<int32_t>(power - (power >> 31)));
    add_column<0>(weight, mean);
    add_column<1>(weight, mean);
    add_column<2>(weight, mean);
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
    const Position x0 = w0.data()[rows_.axis[Row]];
    const Position x1 = w1.data()[rows_.axis[Row]];
    const Position x2 = w2.data()[rows_.axis[Row]];
    const Position x3 = w3.data()[rows_.axis[Row]];
    const Position g2 = kType == TetType::kType2 ? (x2 - x0) + (x2 - x1) : x2 - x1;
    const Position g3 = kType == TetType::kType0   ? x3 - x2
                        : kType == TetType::kType1 ? (x3 - x0) + (x3 - x2)
                                                   : (x3 - x2) + (x3 - x2);
    rows_.c[Row][0] = clamped.clamp<kStretchBits>(x1 - x0);
    rows_.c[Row][1] = clamped.clamp<kStretchBits>(g2);
    rows_.c[Row][2] = clamped.clamp<kStretchBits>(g3);
  }

  /// All of a column is loaded before any of it is stored: a load may have to wait for a store.
  template <int K>
  PALPATE_ALWAYS_INLINE void add_column(Q<0, 31> weight, Matrix3<Strain>& mean) const {
    Strain* column = mean.data() + std::size_t{3} * rows_.axis[K];
    const Q<0, 31> signed_weight = with_sign(rows_.minus[K], weight);
    const Strain sum0 = column[rows_.axis[0]];
    const Strain sum1 = column[rows_.axis[1]];
    const Strain sum2 = column[rows_.axis[2]];
    column[rows_.axis[0]] = with_entry(rows_.c[0][K], signed_weight, sum0);
    column[rows_.axis[1]] = with_entry(rows_.c[1][K], signed_weight, sum1);
    column[rows_.axis[2]] = with_entry(rows_.c[2][K], signed_weight, sum2);
  }
  PALPATE_ALWAYS_INLINE static Strain with_entry(Position c, Q<0, 31> weight, Strain sum) {
    using Twice = Q<3, 28>;  // |A| <= 4
    return multiply_add_high(Twice::from_raw(c.raw() * (2 << kSize)), weight, sum);
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
    const Position stretch[3] = {with_sign(rows_.minus[0], rows_.c[0][0]),
                                 with_sign(rows_.minus[1], rows_.c[1][1]),
                                 with_sign(rows_.minus[2], rows_.c[2][2])};
    const Position trace =
        clamped.clamp<kTraceBits>(stretch[0] + stretch[1] + stretch[2] - (kEdge + kEdge + kEdge));
    const Force pressure = multiply_high<Force>(bulk(material), Q<2, 29>::from_raw(trace.raw() * 4));
    const auto normal = [&](int j) {
      const Position twice_strain = stretch[j] + stretch[j] - (kEdge + kEdge);
      t[j][j] =
          with_sign(rows_.minus[j], clamped.clamp<kForceBits>(multiply_add_high(mu, twice_strain, pressure)));
    };
    const auto tangential = [&](int j, int k) {
      const int32_t minus = rows_.minus[j] ^ rows_.minus[k];
      const Position twice_strain = rows_.c[j][k] + with_sign(minus, rows_.c[k][j]);
      t[j][k] = clamped.clamp<kForceBits>(multiply_high<Force>(mu, twice_strain));
      t[k][j] = with_sign(minus, t[j][k]);
    };
    normal(0);
    normal(1);
    normal(2);
    tangential(0, 1);
    tangential(0, 2);
    tangential(1, 2);
  }

  /// All of a row is loaded before any of it is stored: a load may have to wait for a store that might meet
  /// it.
  template <int Row>
  PALPATE_ALWAYS_INLINE void scatter_row(const Force (&t)[3], Vector3<Force>& f0, Vector3<Force>& f1,
                                         Vector3<Force>& f2, Vector3<Force>& f3) const {
    const auto& [t1, t2, t3] = t;
    const uint32_t axis = rows_.axis[Row];
    const Force sum0 = f0.data()[axis];
    const Force sum1 = f1.data()[axis];
    const Force sum2 = f2.data()[axis];
    const Force sum3 = f3.data()[axis];
    f0.data()[axis] = sum0 + (kType == TetType::kType0 ? t1 : kType == TetType::kType1 ? t1 + t3 : t1 + t2);
    f1.data()[axis] = sum1 + (t2 - t1);
    f2.data()[axis] = sum2 + (kType == TetType::kType2 ? (t3 - t2) + (t3 - t2) : t3 - t2);
    f3.data()[axis] = sum3 - (kType == TetType::kType0 ? t3 : t3 + t3);
  }

  LeafRows rows_;
};

}  // namespace palpate
