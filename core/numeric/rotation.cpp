#include "palpate/numeric/rotation.hpp"

#include "palpate/numeric/reciprocal.hpp"

namespace palpate {
namespace {

Acc<60> dot(const Quaternion& a, const Quaternion& b) {
  return a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
}

}  // namespace

RotationMatrix rotation_matrix(const Quaternion& q) {
  const auto xx = q.x * q.x;
  const auto yy = q.y * q.y;
  const auto zz = q.z * q.z;
  const auto xy = q.x * q.y;
  const auto xz = q.x * q.z;
  const auto yz = q.y * q.z;
  const auto wx = q.w * q.x;
  const auto wy = q.w * q.y;
  const auto wz = q.w * q.z;
  const auto one = widen<60>(RotationEntry::ratio(1, 1));
  const auto twice = [](Acc<60> acc) { return acc + acc; };
  const auto entry = [](Acc<60> acc) { return narrow<RotationEntry>(acc); };
  RotationMatrix r;
  r(0, 0) = entry(one - twice(yy + zz));
  r(0, 1) = entry(twice(xy - wz));
  r(0, 2) = entry(twice(xz + wy));
  r(1, 0) = entry(twice(xy + wz));
  r(1, 1) = entry(one - twice(xx + zz));
  r(1, 2) = entry(twice(yz - wx));
  r(2, 0) = entry(twice(xz - wy));
  r(2, 1) = entry(twice(yz + wx));
  r(2, 2) = entry(one - twice(xx + yy));
  return r;
}

Quaternion normalised(const Quaternion& q) {
  // 1/|q| = (1/sqrt(|q|^2 / 2)) sqrt(1/2), and |q|^2 / 2 is in the root's domain.
  constexpr RotationEntry kRootOfHalf = RotationEntry::ratio(7071067811865475, 10000000000000000);
  constexpr auto kLeast = Q<0, 31>::ratio(1, 4);
  const auto rounded = narrow<Q<0, 31>>(divide_by_power_of_two<1>(dot(q, q)));
  const auto half_square = rounded < kLeast ? kLeast : rounded;
  const auto scale = narrow<RotationEntry>(reciprocal_square_root_normalised(half_square) * kRootOfHalf);
  return Quaternion{narrow<RotationEntry>(q.w * scale), narrow<RotationEntry>(q.x * scale),
                    narrow<RotationEntry>(q.y * scale), narrow<RotationEntry>(q.z * scale)};
}

Quaternion between(const Quaternion& from, const Quaternion& to, RotationEntry fraction) {
  const bool flip = dot(from, to) < Acc<60>::from_raw(0);
  const Quaternion goal = flip ? Quaternion{-to.w, -to.x, -to.y, -to.z} : to;
  if (fraction == RotationEntry::ratio(1, 1)) return goal;
  const auto entry = [fraction](RotationEntry a, RotationEntry b) {
    return a + narrow<RotationEntry>((b - a) * fraction);  // the short way, so |b - a| < 2
  };
  return normalised(
      Quaternion{entry(from.w, goal.w), entry(from.x, goal.x), entry(from.y, goal.y), entry(from.z, goal.z)});
}

Q<4, 27> square_of_difference(const Quaternion& a, const Quaternion& b) {
  const auto x = narrow<RotationEntry>(a.w * b.x - a.x * b.w - a.y * b.z + a.z * b.y);
  const auto y = narrow<RotationEntry>(a.w * b.y - a.y * b.w - a.z * b.x + a.x * b.z);
  const auto z = narrow<RotationEntry>(a.w * b.z - a.z * b.w - a.x * b.y + a.y * b.x);
  return narrow<Q<4, 27>>(Acc<57>::from_raw((x * x + y * y + z * z).raw()));
}

}  // namespace palpate
