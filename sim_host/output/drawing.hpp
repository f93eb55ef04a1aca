// A drawing of bodies as a gnuplot script in the making: polygons in the order in which they cover each
// other.
#pragma once

#include <string>
#include <vector>

#include "output/projection.hpp"
#include "simulation/simulation.hpp"

namespace palpate::sim {

using Points = std::vector<Point3>;
using Triangle = std::array<uint32_t, 3>;

/// Of length 1.
Point3 normal(const Points& at, const Triangle& t);

class Drawing {
 public:
  explicit Drawing(const Point3& towards_viewer) : projection_(towards_viewer) {}

  /// `style`: as gnuplot has it. Two corners are a line.
  void add_polygon(const Points& corners, const std::string& style);
  /// A data block of this name, thinned out.
  void add_line(const char* name, const Points& points);
  /// Makes room for these points.
  void include(const Points& points);

  /// Places in shape.triangles of those that face the viewer, the nearest last.
  [[nodiscard]] std::vector<std::size_t> visible(const BodyShape& shape, const Points& at) const;
  [[nodiscard]] double width() const { return right_ - left_ + 2.0 * kMargin; }
  [[nodiscard]] double height() const { return top_ - bottom_ + 2.0 * kMargin; }
  [[nodiscard]] std::string script() const;

 private:
  static constexpr double kMargin = 6.0;

  std::string x(const Point3& p);
  std::string y(const Point3& p);

  Projection projection_;
  std::string text_;
  double left_ = 1e9, right_ = -1e9, bottom_ = 1e9, top_ = -1e9;
};

}  // namespace palpate::sim
