#include "palpate/numeric/rotation.hpp"

#include "palpate/numeric/high_word.hpp"

namespace palpate {
void rotation_matrix(const Quaternion& q, RotationMatrix& r) {
  put_rotation_matrix(q, [&r](Eigen::Index i, Eigen::Index j, RotationEntry entry) { r(i, j) = entry; });
}

void approach(Quaternion& q, const Quaternion& to, RotationEntry fraction) {
  const int32_t minus = static_cast<int32_t>(dot(q, to).raw() >> 63);
  const Quaternion goal = {with_sign(minus, to.w), with_sign(minus, to.x), with_sign(minus, to.y),
                           with_sign(minus, to.z)};
  if (fraction == RotationEntry::ratio(1, 1)) {
    q = goal;
    return;
  }
  // From halfway, so that what is multiplied by is below a half.
  const auto beyond = Q<-1, 32>::from_raw((fraction.raw() - RotationEntry::ratio(1, 2).raw()) * 4);
  const auto entry = [beyond](RotationEntry a, RotationEntry b) {
    const RotationEntry way = b - a;  // the short one, below 2
    const auto halfway = RotationEntry::from_raw(a.raw() + (way.raw() >> 1));
    return multiply_add_high(way, beyond, halfway);
  };
  q = Quaternion{entry(q.w, goal.w), entry(q.x, goal.x), entry(q.y, goal.y), entry(q.z, goal.z)};
  normalise(q);
}

Q<4, 27> square_of_difference(const Quaternion& a, const Quaternion& b) {
  const auto x = narrow<RotationEntry>(a.w * b.x - a.x * b.w - a.y * b.z + a.z * b.y);
  const auto y = narrow<RotationEntry>(a.w * b.y - a.y * b.w - a.z * b.x + a.x * b.z);
  const auto z = narrow<RotationEntry>(a.w * b.z - a.z * b.w - a.x * b.y + a.y * b.x);
  return narrow<Q<4, 27>>(Acc<57>::from_raw((x * x + y * y + z * z).raw()));
}

}  // namespace palpate
