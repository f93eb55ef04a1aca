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

#include "palpate/elastic/observation.hpp"
#include "palpate/numeric/clamp_flag.hpp"

namespace palpate {

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

  void observe(const Leaf& leaf, uint8_t group_level, Observation& seen) const {
    seen.add(rows_, kSize, leaf.path, static_cast<uint32_t>(Level - group_level));
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

  template <int Row>
  PALPATE_ALWAYS_INLINE void scatter_row(const Force (&t)[3], Vector3<Force>& f0, Vector3<Force>& f1,
                                         Vector3<Force>& f2, Vector3<Force>& f3) const {
    const auto& [t1, t2, t3] = t;
    f0.data()[rows_.axis[Row]] += kType == TetType::kType0   ? t1
                                  : kType == TetType::kType1 ? t1 + t3
                                                             : t1 + t2;
    f1.data()[rows_.axis[Row]] += t2 - t1;
    f2.data()[rows_.axis[Row]] += kType == TetType::kType2 ? (t3 - t2) + (t3 - t2) : t3 - t2;
    f3.data()[rows_.axis[Row]] -= kType == TetType::kType0 ? t3 : t3 + t3;
  }

  LeafRows rows_;
};

}  // namespace palpate
