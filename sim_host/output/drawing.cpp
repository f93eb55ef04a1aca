#include "output/drawing.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace palpate::sim {

Point3 normal(const Points& at, const Triangle& t) {
  const Point3 n = cross(minus(at[t[1]], at[t[0]]), minus(at[t[2]], at[t[0]]));
  const double size = std::max(length(n), 1e-12);
  return {n[0] / size, n[1] / size, n[2] / size};
}

void Drawing::add_polygon(const Points& corners, const std::string& style) {
  text_ += "set object polygon from ";
  for (const Point3& p : corners) text_ += fmt::format("{},{} to ", x(p), y(p));
  text_ += fmt::format("{},{} {}\n", x(corners[0]), y(corners[0]), style);
}

void Drawing::add_line(const char* name, const Points& points) {
  constexpr std::size_t kPoints = 500;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kPoints);
  text_ += fmt::format("${} << EOD\n", name);
  for (std::size_t i = 0; i < points.size(); i += stride)
    text_ += fmt::format("{} {}\n", x(points[i]), y(points[i]));
  text_ += "EOD\n";
}

void Drawing::include(const Points& points) {
  for (const Point3& p : points) {
    x(p);
    y(p);
  }
}

std::vector<std::size_t> Drawing::visible(const BodyShape& shape, const Points& at) const {
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < shape.triangles.size(); ++i) {
    if (projection_.nearness(normal(at, shape.triangles[i])) > 0.0) front.push_back(i);
  }
  const auto nearness = [&](std::size_t i) {
    const Triangle& t = shape.triangles[i];
    return projection_.nearness(at[t[0]]) + projection_.nearness(at[t[1]]) + projection_.nearness(at[t[2]]);
  };
  std::stable_sort(front.begin(), front.end(),
                   [&](std::size_t a, std::size_t b) { return nearness(a) < nearness(b); });
  return front;
}

std::string Drawing::script() const {
  return fmt::format("set xrange [{:.2f}:{:.2f}]\nset yrange [{:.2f}:{:.2f}]\n", left_ - kMargin,
                     right_ + kMargin, bottom_ - kMargin, top_ + kMargin) +
         text_;
}

std::string Drawing::x(const Point3& p) {
  const double at = projection_.right(p);
  left_ = std::min(left_, at);
  right_ = std::max(right_, at);
  return fmt::format("{:.2f}", at);
}

std::string Drawing::y(const Point3& p) {
  const double at = projection_.up(p);
  bottom_ = std::min(bottom_, at);
  top_ = std::max(top_, at);
  return fmt::format("{:.2f}", at);
}

}  // namespace palpate::sim
