// The corotated force of one leaf in its group's frame, in the hot loop's form. With the leaf's signed axes
// as a signed permutation S (tet_shape.hpp), B = S^T A S has the rows
//   B_jk = s_j (g_k)[axis j] / h,
// so axes are addresses and signs belong to rows. The isotropic law commutes with S, and row j of the stress
// gives component axis j of all three edge forces, with the sign s_j again. Off the diagonal only s_j s_k
// matters, and it is applied twice.
//
// Nothing is scaled by h: with c_jk = (g_k)[axis j] and t the type, an edge's force is sigma h^2 / 2^t, so
//   s_j sigma_jk h^2 / 2^t = mu h / 2^t (c_jk + s_j s_k c_kj),
//   s_j sigma_jj h^2 / 2^t = 2 mu h / 2^t c_jj + s_j (lambda h / 2^t trace - 2 mu h^2 / 2^t),
// and the coefficients carry the powers of two. Code of its own for each level has them as constants.
#pragma once

#include "palpate/elastic/element_force.hpp"
#include "palpate/numeric/clamp_flag.hpp"
#include "palpate/numeric/high_word.hpp"

namespace palpate {

/// The edge vectors of a leaf, row by row, with the axis and the sign, 1 or -1, of each row.
struct LeafRows {
  Position c[3][3];
  uint32_t axis[3];
  int32_t sign[3];
};

/// A force in a group's frame: the sum at a node is below 24.
using FrameForce = Q<5, 26>;

/// The mean of A = R^T F over leaves, transposed: row j of a leaf goes to column axis j. Of four rows, of
/// which the last is unused, so that a column is a shift away.
using MeanGradient = Eigen::Matrix<Strain, 4, 3>;

template <uint8_t Level>
class LeafForce {
 public:
  PALPATE_ALWAYS_INLINE explicit LeafForce(Axes axes)
      : rows_{{},
              {axes.axis(0), axes.axis(1), axes.axis(2)},
              {sign_of(axes, 0), sign_of(axes, 1), sign_of(axes, 2)}} {}

  /// The edge vectors, from the positions of the four nodes in the group's frame: within +-4 edges.
  PALPATE_ALWAYS_INLINE void gather(const Vector3<Position>& w0, const Vector3<Position>& w1,
                                    const Vector3<Position>& w2, const Vector3<Position>& w3,
                                    ClampFlag& clamped) {
    gather_row<0>(w0, w1, w2, w3, clamped);
    gather_row<1>(w0, w1, w2, w3, clamped);
    gather_row<2>(w0, w1, w2, w3, clamped);
  }

  /// Adds 2^-depth A. From the rows, A[axis j][axis k] = s_k c_jk / h.
  PALPATE_ALWAYS_INLINE void add_gradient(uint32_t depth, MeanGradient& mean) const {
    // For a group of one leaf the largest below 1.
    const uint32_t power = 0x80000000u >> depth;
    const auto weight = Q<0, 31>::from_raw(static_cast<int32_t>(power - (power >> 31)));
    const Q<0, 31> weights[3] = {times(rows_.sign[0], weight), times(rows_.sign[1], weight),
                                 times(rows_.sign[2], weight)};
    add_row<0>(weights, mean);
    add_row<1>(weights, mean);
    add_row<2>(weights, mean);
  }

  /// Looks the material up: before the gradient is stored, for which a load would have to wait.
  PALPATE_ALWAYS_INLINE void set_stresses(const Material& material, ClampFlag& clamped) {
    stresses_ = stresses(material, clamped);
  }

  /// Adds the nodal forces, from t_jk, component axis j of the force that pulls at g_k. 7 multiplies beside
  /// those by signs.
  PALPATE_ALWAYS_INLINE void scatter(Vector3<FrameForce>& f0, Vector3<FrameForce>& f1,
                                     Vector3<FrameForce>& f2, Vector3<FrameForce>& f3,
                                     ClampFlag& clamped) const {
    FrameForce t[3][3];
    const Stresses of = stresses_;
    const auto normal = [&](int j) {
      t[j][j] = clamped.clamp<kForceBits>(
          multiply_add_high(of.twice_mu, rows_.c[j][j], times(rows_.sign[j], of.at_no_stretch)));
    };
    const auto tangential = [&](int j, int k) {
      const int32_t sign = rows_.sign[j] * rows_.sign[k];
      const auto mu = Q<0, 31>::from_raw(of.twice_mu.raw() >> 1);
      const Position twice_strain = rows_.c[j][k] + times(sign, rows_.c[k][j]);
      t[j][k] = clamped.clamp<kForceBits>(multiply_high<FrameForce>(mu, twice_strain));
      t[k][j] = times(sign, t[j][k]);
    };
    normal(0);
    normal(1);
    normal(2);
    tangential(0, 1);
    tangential(0, 2);
    scatter_row<0>(t[0], f0, f1, f2, f3);
    tangential(1, 2);  // in the time that the next row's loads may have to wait
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
  static constexpr int kForceBits = 26 - 2 * kSize - kTypeBits;
  static_assert(kStretchLimit == 4 && kTraceLimit.raw() == (int32_t{1} << 28) - 1 &&
                    kStressLimit == Stress::ratio(1, 2),
                "palpate: the limits are powers of two");

  /// 1 or -1, from the sign's bit: a condition would become a branch.
  PALPATE_ALWAYS_INLINE static int32_t sign_of(Axes axes, uint32_t k) {
    return (static_cast<int32_t>(uint32_t{axes.code()} << (29u - 3u * k)) >> 31) | 1;
  }
  /// A product, so that with a sum it is one instruction.
  template <class Fixed>
  PALPATE_ALWAYS_INLINE static Fixed times(int32_t sign, Fixed value) {
    return Fixed::from_raw(sign * value.raw());
  }

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

  /// All of a row is loaded before any of it is stored: a load may have to wait for a store.
  template <int Row>
  PALPATE_ALWAYS_INLINE void add_row(const Q<0, 31> (&weights)[3], MeanGradient& mean) const {
    Strain* row = mean.data() + std::size_t{4} * rows_.axis[Row];
    const Strain sum0 = row[rows_.axis[0]];
    const Strain sum1 = row[rows_.axis[1]];
    const Strain sum2 = row[rows_.axis[2]];
    row[rows_.axis[0]] = with_entry(rows_.c[Row][0], weights[0], sum0);
    row[rows_.axis[1]] = with_entry(rows_.c[Row][1], weights[1], sum1);
    row[rows_.axis[2]] = with_entry(rows_.c[Row][2], weights[2], sum2);
  }
  PALPATE_ALWAYS_INLINE static Strain with_entry(Position c, Q<0, 31> weight, Strain sum) {
    using Twice = Q<3, 28>;  // |A| <= 4
    return multiply_add_high(Twice::from_raw(c.raw() * (2 << kSize)), weight, sum);
  }

  /// 2 mu h / 2^t, at most 1/6. Odd, so that no product of it and h is halfway between two numbers: products
  /// of h and -h are then rounded to opposite ones, and a leaf at rest pulls at nothing.
  PALPATE_ALWAYS_INLINE static Q<0, 31> twice_shear(const Material& material) {
    return Q<0, 31>::from_raw((scaled<1 - kSize - kTypeBits>(material.shear.raw())) | 1);
  }
  /// lambda h / 2^t times the trace, which is within 2 h.
  PALPATE_ALWAYS_INLINE static FrameForce pressure(const Material& material, Position trace) {
    constexpr int kShift = 3 - kSize - kTypeBits;
    constexpr int kOfTrace = kShift > 0 ? kShift : 0;
    return multiply_high<FrameForce>(Q<0, 31>::from_raw(scaled<kShift - kOfTrace>(material.bulk.raw())),
                                     Position::from_raw(scaled<kOfTrace>(trace.raw())));
  }
  /// raw 2^Shift, cut where that is a fraction.
  template <int Shift>
  PALPATE_ALWAYS_INLINE static int32_t scaled(int32_t raw) {
    if constexpr (Shift < 0) {
      return raw >> -Shift;
    } else {
      return raw * (1 << Shift);
    }
  }

  /// What the stress is made of beside the strain: 2 mu h / 2^t and lambda h / 2^t trace - 2 mu h^2 / 2^t.
  struct Stresses {
    Q<0, 31> twice_mu;
    FrameForce at_no_stretch;
  };
  PALPATE_ALWAYS_INLINE Stresses stresses(const Material& material, ClampFlag& clamped) const {
    const auto& c = rows_.c;
    const auto& s = rows_.sign;
    const Q<0, 31> twice_mu = twice_shear(material);
    const Position stretches = times(s[0], c[0][0]) + times(s[1], c[1][1]) + times(s[2], c[2][2]);
    const Position trace = clamped.clamp<kTraceBits>(stretches - (kEdge + kEdge + kEdge));
    return {twice_mu, pressure(material, trace) - multiply_high<FrameForce>(twice_mu, kEdge)};
  }

  /// All of a row is loaded before any of it is stored: a load may have to wait for a store that might meet
  /// it.
  template <int Row>
  PALPATE_ALWAYS_INLINE void scatter_row(const FrameForce (&t)[3], Vector3<FrameForce>& f0,
                                         Vector3<FrameForce>& f1, Vector3<FrameForce>& f2,
                                         Vector3<FrameForce>& f3) const {
    const auto& [t1, t2, t3] = t;
    const uint32_t axis = rows_.axis[Row];
    const FrameForce sum0 = f0.data()[axis];
    const FrameForce sum1 = f1.data()[axis];
    const FrameForce sum2 = f2.data()[axis];
    const FrameForce sum3 = f3.data()[axis];
    f0.data()[axis] = sum0 + (kType == TetType::kType0 ? t1 : kType == TetType::kType1 ? t1 + t3 : t1 + t2);
    f1.data()[axis] = sum1 + (t2 - t1);
    f2.data()[axis] = sum2 + (kType == TetType::kType2 ? (t3 - t2) + (t3 - t2) : t3 - t2);
    f3.data()[axis] = sum3 - (kType == TetType::kType0 ? t3 : t3 + t3);
  }

  LeafRows rows_;
  Stresses stresses_;
};

}  // namespace palpate
