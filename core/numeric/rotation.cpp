#include "palpate/numeric/rotation.hpp"

namespace palpate {

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

}  // namespace palpate
