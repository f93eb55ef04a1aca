// A parallel projection onto a picture: from above, turned about the vertical z.
#pragma once

#include <array>
#include <cmath>

namespace palpate::sim {

using Point3 = std::array<double, 3>;

inline Point3 minus(const Point3& a, const Point3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline double dot(const Point3& a, const Point3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Point3 cross(const Point3& a, const Point3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Point3& a) { return std::sqrt(dot(a, a)); }

class Projection {
 public:
  /// The viewer stands in this direction.
  explicit Projection(const Point3& towards_viewer)
      : towards_(scaled(towards_viewer)),
        right_(scaled(cross({0.0, 0.0, 1.0}, towards_))),
        up_(cross(towards_, right_)) {}

  [[nodiscard]] double right(const Point3& p) const { return dot(p, right_); }
  [[nodiscard]] double up(const Point3& p) const { return dot(p, up_); }
  /// Larger is nearer.
  [[nodiscard]] double nearness(const Point3& p) const { return dot(p, towards_); }

 private:
  static Point3 scaled(const Point3& p) {
    const double size = length(p);
    return {p[0] / size, p[1] / size, p[2] / size};
  }

  Point3 towards_, right_, up_;
};

}  // namespace palpate::sim
