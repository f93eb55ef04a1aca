#include "palpate/elastic/rotation_extraction.hpp"

#include "palpate/numeric/high_word.hpp"
#include "palpate/numeric/reciprocal.hpp"

namespace palpate {
namespace {

using Unit = Q<1, 30>;    // H and a after normalisation: within +-1
using Minor = Q<3, 28>;   // 2x2 minors of it: within +-2
using Triple = Q<3, 28>;  // determinant and adjugate times a: within +-6
using Half = Q<-1, 32>;   // half of omega

/// Determinant of the normalised H below which the Newton step is not trusted.
constexpr Triple kSmallDeterminant = Triple::ratio(1, 512);

/// H omega = a, scaled by a power of two so that its largest entry is in [1/2, 1]. Off the diagonal it holds
/// -H.
struct NewtonSystem {
  Unit h00, h11, h22, minus_h01, minus_h02, minus_h12;
  Vector3<Unit> a;
};

/// The bits of |raw|, or of one below it.
uint32_t bits_of(int32_t raw) { return static_cast<uint32_t>(raw ^ (raw >> 31)); }

NewtonSystem newton_system(const Matrix3<Corotated>& b) {
  // Half of what is wanted on the diagonal and of a: |sums| <= 2 * 14 fit 30 bits with 24 fraction bits.
  const int32_t h00 = b(1, 1).raw() + b(2, 2).raw();
  const int32_t h11 = b(0, 0).raw() + b(2, 2).raw();
  const int32_t h22 = b(0, 0).raw() + b(1, 1).raw();
  const int32_t a0 = b(2, 1).raw() - b(1, 2).raw();
  const int32_t a1 = b(0, 2).raw() - b(2, 0).raw();
  const int32_t a2 = b(1, 0).raw() - b(0, 1).raw();
  const int32_t h01 = b(0, 1).raw() + b(1, 0).raw();
  const int32_t h02 = b(0, 2).raw() + b(2, 0).raw();
  const int32_t h12 = b(1, 2).raw() + b(2, 1).raw();
  const uint32_t halves =
      bits_of(h00) | bits_of(h11) | bits_of(h22) | bits_of(a0) | bits_of(a1) | bits_of(a2);
  const uint32_t bits = (halves << 1) | bits_of(h01) | bits_of(h02) | bits_of(h12) | 1u;
  const int room = leading_zeros(bits) - 2;  // bits < 2^30, so never negative
  const auto unit = [](int32_t raw, int shift) {
    return Unit::from_raw(static_cast<int32_t>(static_cast<uint32_t>(raw) << shift));
  };
  return NewtonSystem{unit(h00, room + 1),
                      unit(h11, room + 1),
                      unit(h22, room + 1),
                      unit(h01, room),
                      unit(h02, room),
                      unit(h12, room),
                      Vector3<Unit>(unit(a0, room + 1), unit(a1, room + 1), unit(a2, room + 1))};
}

/// Half of omega = adj(H) a / det(H), or of a / 2 where H is not safely positive definite. At most 1/2 less
/// 1/2048.
Vector3<Half> half_step(const NewtonSystem& s) {
  const Minor c00 = narrow<Minor>(s.h11 * s.h22 + s.minus_h12 * -s.minus_h12);
  const Minor c11 = narrow<Minor>(s.h00 * s.h22 + s.minus_h02 * -s.minus_h02);
  const Minor c22 = narrow<Minor>(s.h00 * s.h11 + s.minus_h01 * -s.minus_h01);
  const Minor c01 = narrow<Minor>(s.minus_h02 * s.minus_h12 + s.minus_h01 * s.h22);
  const Minor c02 = narrow<Minor>(s.minus_h01 * s.minus_h12 + s.minus_h02 * s.h11);
  const Minor c12 = narrow<Minor>(s.minus_h01 * s.minus_h02 + s.minus_h12 * s.h00);
  const Triple determinant = narrow<Triple>(s.h00 * c00 - (s.minus_h01 * c01 + s.minus_h02 * c02));
  const bool newton = s.h00.raw() > 0 && c22.raw() > 0 && determinant > kSmallDeterminant;
  const int32_t is_newton = newton ? -1 : 0;  // without a branch

  const Triple divisor = newton ? determinant : Triple::ratio(2, 1);
  const Triple limit = Triple::from_raw(divisor.raw() - (divisor.raw() >> 10));  // a step below 1 radian
  // Of both sides of the fraction the mantissa is taken.
  const int room = leading_zeros(static_cast<uint32_t>(divisor.raw())) - 1;
  const auto mantissa = [room](Triple x) {
    return static_cast<int32_t>(static_cast<uint32_t>(x.raw()) << room);
  };
  const Q<1, 30> reciprocal = reciprocal_normalised(Q<0, 31>::from_raw(mantissa(divisor)));
  const auto solve_row = [&](Minor c0, Minor c1, Minor c2, Unit gradient) {
    const Triple product = narrow<Triple>(c0 * s.a[0] + c1 * s.a[1] + c2 * s.a[2]);
    const auto dividend =
        Triple::from_raw((product.raw() & is_newton) | ((gradient.raw() >> 2) & ~is_newton));
    const int32_t minus = dividend.raw() >> 31;
    const Triple size = with_sign(minus, dividend);
    const auto half = Half::from_raw(mantissa(size < limit ? size : limit));
    return with_sign(minus, Half::from_raw(multiply_high<Unit>(half, reciprocal).raw() * 4));
  };
  return Vector3<Half>(solve_row(c00, c01, c02, s.a[0]), solve_row(c01, c11, c12, s.a[1]),
                       solve_row(c02, c12, c22, s.a[2]));
}

/// q (1, half), normalised: a Cayley update, which also removes the rounding of the step before.
void cayley_update(const Vector3<Half>& half, Quaternion& q) {
  const auto entry = [](RotationEntry of_q, Acc<62> product) {
    return narrow<RotationEntry>(widen<62>(of_q) + product);
  };
  const Half x = half[0];
  const Half y = half[1];
  const Half z = half[2];
  q = Quaternion{entry(q.w, q.x * -x + q.y * -y + q.z * -z), entry(q.x, q.w * x + q.y * z + q.z * -y),
                 entry(q.y, q.w * y + q.z * x + q.x * -z), entry(q.z, q.w * z + q.x * y + q.y * -x)};
  normalise(q);  // |q|^2 is in [1, 1.75]
}

}  // namespace

void extract_rotation(const DeformationGradient& f, Quaternion& q) {
  const Matrix3<Corotated> b = narrow<Corotated>(rotation_matrix(q).transpose() * f);
  cayley_update(half_step(newton_system(b)), q);
}

}  // namespace palpate
