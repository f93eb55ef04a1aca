#include "palpate/elastic/rotation_extraction.hpp"

#include "palpate/numeric/reciprocal.hpp"

namespace palpate {
namespace {

using Unit = Q<1, 30>;    // H and a after normalisation: within +-1
using Minor = Q<1, 30>;   // 2x2 minors of it: within +-2
using Triple = Q<3, 28>;  // determinant and adjugate times a: within +-6

/// Radians a step and component.
constexpr Unit kStepLimit = Unit::ratio(1, 1);
/// Determinant of the normalised H below which the Newton step is not trusted.
constexpr Triple kSmallDeterminant = Triple::ratio(1, 512);

struct NewtonSystem {  // H omega = a, scaled by a power of two so that its largest entry is in [1/2, 1)
  Unit h00, h01, h02, h11, h12, h22;
  Vector3<Unit> a;
};

uint32_t magnitude(int32_t raw) { return static_cast<uint32_t>(raw < 0 ? -raw : raw); }

NewtonSystem newton_system(const Matrix3<Corotated>& b) {
  // Twice H and twice a, so that nothing is halved: |entries| <= 4 * 14 fit 32 bits with 24 fraction bits.
  const int32_t h00 = 2 * (b(1, 1).raw() + b(2, 2).raw());
  const int32_t h11 = 2 * (b(0, 0).raw() + b(2, 2).raw());
  const int32_t h22 = 2 * (b(0, 0).raw() + b(1, 1).raw());
  const int32_t h01 = -(b(0, 1).raw() + b(1, 0).raw());
  const int32_t h02 = -(b(0, 2).raw() + b(2, 0).raw());
  const int32_t h12 = -(b(1, 2).raw() + b(2, 1).raw());
  const int32_t a0 = 2 * (b(2, 1).raw() - b(1, 2).raw());
  const int32_t a1 = 2 * (b(0, 2).raw() - b(2, 0).raw());
  const int32_t a2 = 2 * (b(1, 0).raw() - b(0, 1).raw());
  const uint32_t bits = magnitude(h00) | magnitude(h11) | magnitude(h22) | magnitude(h01) | magnitude(h02) |
                        magnitude(h12) | magnitude(a0) | magnitude(a1) | magnitude(a2) | 1u;
  const int room = leading_zeros(bits) - 2;  // bits < 2^30, so never negative
  const auto unit = [room](int32_t raw) {
    return Unit::from_raw(static_cast<int32_t>(static_cast<uint32_t>(raw) << room));
  };
  return NewtonSystem{unit(h00),
                      unit(h01),
                      unit(h02),
                      unit(h11),
                      unit(h12),
                      unit(h22),
                      Vector3<Unit>(unit(a0), unit(a1), unit(a2))};
}

Unit clamp_step(int64_t raw) {
  const int64_t limit = kStepLimit.raw();
  const int64_t at_least_low = raw < -limit ? -limit : raw;
  return Unit::from_raw(static_cast<int32_t>(at_least_low > limit ? limit : at_least_low));
}

/// omega = adj(H) a / det(H), or a / 2 where H is not safely positive definite.
Vector3<Unit> step(const NewtonSystem& s) {
  const Minor c00 = narrow<Minor>(s.h11 * s.h22 - s.h12 * s.h12);
  const Minor c01 = narrow<Minor>(s.h02 * s.h12 - s.h01 * s.h22);
  const Minor c02 = narrow<Minor>(s.h01 * s.h12 - s.h02 * s.h11);
  const Minor c11 = narrow<Minor>(s.h00 * s.h22 - s.h02 * s.h02);
  const Minor c12 = narrow<Minor>(s.h01 * s.h02 - s.h00 * s.h12);
  const Minor c22 = narrow<Minor>(s.h00 * s.h11 - s.h01 * s.h01);
  const Triple determinant = narrow<Triple>(s.h00 * c00 + s.h01 * c01 + s.h02 * c02);
  const bool newton = s.h00.raw() > 0 && c22.raw() > 0 && determinant > kSmallDeterminant;

  const Triple safe = newton ? determinant : Triple::ratio(1, 1);
  const int room = leading_zeros(static_cast<uint32_t>(safe.raw())) - 1;
  const auto mantissa = Q<0, 31>::from_raw(static_cast<int32_t>(static_cast<uint32_t>(safe.raw()) << room));
  // determinant = mantissa 2^(31 - 28 - room), so 1 / determinant = reciprocal 2^(room - 3).
  const Q<1, 30> reciprocal = reciprocal_normalised(mantissa);
  const auto solve_row = [&](Minor c0, Minor c1, Minor c2, Unit gradient) {
    const Triple numerator = narrow<Triple>(c0 * s.a[0] + c1 * s.a[1] + c2 * s.a[2]);
    const auto quotient = narrow<Q<4, 27>>(numerator * reciprocal);
    const int64_t raw = static_cast<int64_t>(quotient.raw()) * (int64_t{1} << room);  // 27 + 3 = 30 bits
    return clamp_step(newton ? raw : gradient.raw() / 2);
  };
  return Vector3<Unit>(solve_row(c00, c01, c02, s.a[0]), solve_row(c01, c11, c12, s.a[1]),
                       solve_row(c02, c12, c22, s.a[2]));
}

/// q (1, omega / 2), normalised: a Cayley update, which also removes the rounding of the step before.
Quaternion cayley_update(const Quaternion& q, const Vector3<Unit>& omega) {
  const auto half = [](Unit u) { return Unit::from_raw((u.raw() + 1) >> 1); };
  const Unit one = Unit::ratio(1, 1);
  const Unit x = half(omega[0]);
  const Unit y = half(omega[1]);
  const Unit z = half(omega[2]);
  const Unit pw = narrow<Unit>(q.w * one - q.x * x - q.y * y - q.z * z);
  const Unit px = narrow<Unit>(q.x * one + q.w * x + q.y * z - q.z * y);
  const Unit py = narrow<Unit>(q.y * one + q.w * y + q.z * x - q.x * z);
  const Unit pz = narrow<Unit>(q.z * one + q.w * z + q.x * y - q.y * x);
  return normalised(Quaternion{pw, px, py, pz});  // |p|^2 is in [1, 1.75]
}

}  // namespace

Quaternion extract_rotation(const DeformationGradient& f, const Quaternion& warm) {
  const Matrix3<Corotated> b = narrow<Corotated>(rotation_matrix(warm).transpose() * f);
  return cayley_update(warm, step(newton_system(b)));
}

}  // namespace palpate
