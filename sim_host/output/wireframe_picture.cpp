#include "output/wireframe_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "output/drawing.hpp"

namespace palpate::sim {
namespace {

// A bar that bends towards high y is seen from its side, from high x and above.
constexpr Point3 kTowardsWireframeViewer = {0.80, -0.48, 0.36};
constexpr Point3 kWireframeLight = {0.75, -0.15, 0.64};
constexpr std::array<double, 3> kTissue = {250, 240, 229};

constexpr const char* kBold = "fs empty border rgb '#d0021b' lw 2.4";

using Edge = std::pair<uint32_t, uint32_t>;

/// The edges of the visible surface, each with the places of its triangles.
class SurfaceEdges {
 public:
  explicit SurfaceEdges(const BodyShape& shape) : shape_(shape) {
    for (std::size_t i = 0; i < shape.triangles.size(); ++i) {
      for (const Edge& edge : edges_of(shape.triangles[i])) triangles_[edge].push_back(i);
    }
  }

  static std::array<Edge, 3> edges_of(const Triangle& t) {
    return {std::minmax(t[0], t[1]), std::minmax(t[1], t[2]), std::minmax(t[2], t[0])};
  }

  /// Whether it is an edge of rotation tets: they differ at it, or the rest shape's faces meet in it, where
  /// one tet has both.
  [[nodiscard]] bool is_of_rotation_tet(const Edge& edge) const {
    constexpr double kFlat = 0.999;
    const auto& sides = triangles_.at(edge);
    if (sides.size() != 2) return true;
    if (shape_.rotation_tet[sides[0]] != shape_.rotation_tet[sides[1]]) return true;
    return dot(normal(shape_.rest_mm, shape_.triangles[sides[0]]),
               normal(shape_.rest_mm, shape_.triangles[sides[1]])) < kFlat;
  }

 private:
  const BodyShape& shape_;
  std::map<Edge, std::vector<std::size_t>> triangles_;
};

std::string colour_of(const BodyShape& shape, const Triangle& t) {
  const double shade = 0.72 + 0.28 * std::max(0.0, dot(normal(shape.now_mm, t), kWireframeLight));
  const auto channel = [&](std::size_t i) { return static_cast<int>(shade * kTissue[i]); };
  return fmt::format("fc rgb '#{:02x}{:02x}{:02x}' fs solid 1.0 border rgb '#a9a39b' lw 0.6", channel(0),
                     channel(1), channel(2));
}

/// Bold lines follow both of their triangles, or the second one would cover a half of them.
void draw_body(const WireframePicture& picture, Drawing& drawing) {
  const BodyShape& shape = picture.shape;
  const SurfaceEdges edges(shape);
  const std::vector<std::size_t> order = drawing.visible(shape, shape.now_mm);
  std::map<Edge, std::size_t> last;
  for (const std::size_t i : order) {
    for (const Edge& edge : SurfaceEdges::edges_of(shape.triangles[i])) last[edge] = i;
  }
  for (const std::size_t i : order) {
    const Triangle& t = shape.triangles[i];
    drawing.add_polygon({shape.now_mm[t[0]], shape.now_mm[t[1]], shape.now_mm[t[2]]}, colour_of(shape, t));
    for (const Edge& edge : SurfaceEdges::edges_of(t)) {
      const bool is_bold = picture.shows_rotation_tets && edges.is_of_rotation_tet(edge);
      if (!is_bold || last[edge] != i) continue;
      drawing.add_polygon({shape.now_mm[edge.first], shape.now_mm[edge.second]}, kBold);
    }
  }
}

}  // namespace

std::string wireframe_script(const std::vector<WireframePicture>& pictures) {
  constexpr double kSvgPixels = 520.0;  // of the longer side
  constexpr double kPngPixels = 1200.0;
  std::string text;
  for (const WireframePicture& picture : pictures) {
    Drawing drawing(kTowardsWireframeViewer);
    for (const WireframePicture& other : pictures) drawing.include(other.shape.now_mm);
    draw_body(picture, drawing);
    const double longer = std::max(drawing.width(), drawing.height());
    const auto size = [&](double pixels) {
      return fmt::format("{:.0f},{:.0f}", pixels * drawing.width() / longer,
                         pixels * drawing.height() / longer);
    };
    text += "reset\n" + drawing.script() +
            "set size ratio -1\nunset border\nunset tics\nset margins 0, 0, 0, 0\nunset key\n";
    text += fmt::format(
        "set terminal svg size {} background '#ffffff'\nset output '{}.svg'\nplot NaN\nunset output\n",
        size(kSvgPixels), picture.file);
    text += fmt::format(
        "set terminal pngcairo size {} linewidth 2.2\nset output '{}.png'\nplot NaN\nunset output\n",
        size(kPngPixels), picture.file);
  }
  return text;
}

}  // namespace palpate::sim
