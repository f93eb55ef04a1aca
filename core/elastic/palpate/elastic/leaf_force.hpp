// The corotated force of one leaf in its group's frame, in the hot loop's form. With the leaf's signed axes
// as a signed permutation S (tet_shape.hpp), B = S^T A S has the rows
//   B_jk = s_j (g_k)[axis j] / h,
// so axes are addresses and signs belong to rows; the isotropic law commutes with S, and row j of the stress
// gives component axis j of all three edge forces.
#pragma once

#include "palpate/elastic/element_force.hpp"

namespace palpate {

/// Where row j of a leaf is in a vector, and its sign as a mask: 0, or -1 for minus.
struct SignedAxis {
  uint32_t axis;
  int32_t mask;
  [[nodiscard]] int32_t apply(int32_t raw) const { return (raw ^ mask) - mask; }
};

inline SignedAxis signed_axis(Axes axes, uint32_t j) {
  return SignedAxis{axes.axis(j), axes.is_negative(j) ? -1 : 0};
}

template <TetType Type>
class LeafForce {
 public:
  LeafForce(Axes axes, uint8_t level)
      : axes_{signed_axis(axes, 0), signed_axis(axes, 1), signed_axis(axes, 2)},
        size_(size_of_level(level)) {}

  /// B from the positions of the four nodes in the group's frame.
  PALPATE_ALWAYS_INLINE void gather(const Vector3<Position>& w0, const Vector3<Position>& w1,
                                    const Vector3<Position>& w2, const Vector3<Position>& w3,
                                    uint32_t& clamped) {
    gather_row<0>(w0, w1, w2, w3, clamped);
    gather_row<1>(w0, w1, w2, w3, clamped);
    gather_row<2>(w0, w1, w2, w3, clamped);
  }

  /// A = S B S^T.
  [[nodiscard]] PALPATE_ALWAYS_INLINE Matrix3<Strain> gradient() const {
    Matrix3<Strain> a;
    for (const uint32_t i : bounded<9>(9, [] {})) {
      const SignedAxis row = axes_[i / 3];
      const SignedAxis column = axes_[i % 3];
      a.data()[row.axis + 3 * column.axis] =
          Strain::from_raw(row.apply(column.apply(b_.data()[i / 3 + 3 * (i % 3)].raw())));
    }
    return a;
  }

  /// Adds the nodal forces.
  PALPATE_ALWAYS_INLINE void scatter(const Material& material, Vector3<Force>& f0, Vector3<Force>& f1,
                                     Vector3<Force>& f2, Vector3<Force>& f3, uint32_t& clamped) const {
    const Matrix3<Stress> sigma = corotated_stress(b_, material, clamped);
    scatter_row<0>(sigma, f0, f1, f2, f3);
    scatter_row<1>(sigma, f0, f1, f2, f3);
    scatter_row<2>(sigma, f0, f1, f2, f3);
  }

 private:
  template <int Row>
  PALPATE_ALWAYS_INLINE void gather_row(const Vector3<Position>& w0, const Vector3<Position>& w1,
                                        const Vector3<Position>& w2, const Vector3<Position>& w3,
                                        uint32_t& clamped) {
    const SignedAxis at = axes_[Row];
    const int32_t x0 = w0.data()[at.axis].raw();
    const int32_t x1 = w1.data()[at.axis].raw();
    const int32_t x2 = w2.data()[at.axis].raw();
    const int32_t x3 = w3.data()[at.axis].raw();
    const int32_t g2 = Type == TetType::kType2 ? (x2 - x0) + (x2 - x1) : x2 - x1;
    const int32_t g3 = Type == TetType::kType0   ? x3 - x2
                       : Type == TetType::kType1 ? (x3 - x0) + (x3 - x2)
                                                 : 2 * (x3 - x2);
    b_(Row, 0) = stretch(x1 - x0, at, clamped);
    b_(Row, 1) = stretch(g2, at, clamped);
    b_(Row, 2) = stretch(g3, at, clamped);
  }

  [[nodiscard]] PALPATE_ALWAYS_INLINE Strain stretch(int32_t g, const SignedAxis& at,
                                                     uint32_t& clamped) const {
    const int32_t limit = (int32_t{kStretchLimit} << Strain::kFractionBits) >> size_;
    const int32_t low = g < -limit ? -limit : g;
    const int32_t within = low > limit ? limit : low;
    clamped |= static_cast<uint32_t>(within ^ g);
    return Strain::from_raw(at.apply(static_cast<int32_t>(static_cast<uint32_t>(within) << size_)));
  }

  template <int Row>
  PALPATE_ALWAYS_INLINE void scatter_row(const Matrix3<Stress>& sigma, Vector3<Force>& f0, Vector3<Force>& f1,
                                         Vector3<Force>& f2, Vector3<Force>& f3) const {
    const SignedAxis at = axes_[Row];
    const uint32_t shift = 2u * size_ + static_cast<uint32_t>(Type) + 1u;
    const int32_t half = static_cast<int32_t>(uint32_t{1} << (shift - 1u));
    const auto edge = [&](int k) { return Force::from_raw(at.apply((sigma(Row, k).raw() + half) >> shift)); };
    const Force t1 = edge(0);
    const Force t2 = edge(1);
    const Force t3 = edge(2);
    Force& y0 = f0.data()[at.axis];
    Force& y1 = f1.data()[at.axis];
    Force& y2 = f2.data()[at.axis];
    Force& y3 = f3.data()[at.axis];
    y0 += Type == TetType::kType0 ? t1 : Type == TetType::kType1 ? t1 + t3 : t1 + t2;
    y1 += t2 - t1;
    y2 += Type == TetType::kType2 ? (t3 - t2) + (t3 - t2) : t3 - t2;
    y3 -= Type == TetType::kType0 ? t3 : t3 + t3;
  }

  SignedAxis axes_[3];
  uint32_t size_;
  Matrix3<Strain> b_;
};

}  // namespace palpate
