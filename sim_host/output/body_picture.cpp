#include "output/body_picture.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "output/drawing.hpp"
#include "palpate/tick/state.hpp"

namespace palpate::sim {
namespace {

// From low x and high y: the grasped corner is in front, the drag goes to the left.
constexpr Point3 kTowardsBodyViewer = {-0.80, 0.45, 0.36};
constexpr Point3 kBodyLight = {-0.60, 0.20, 0.77};
// Colours of no displacement and of the largest one.
constexpr std::array<double, 3> kStill = {250, 238, 225};
constexpr std::array<double, 3> kFar = {196, 30, 50};

double displacement(const BodyShape& shape, uint32_t node) {
  return length(minus(shape.now_mm[node], shape.rest_mm[node]));
}

double largest_displacement(const BodyShape& shape) {
  double largest = 1e-3;
  for (uint32_t i = 0; i < shape.rest_mm.size(); ++i) largest = std::max(largest, displacement(shape, i));
  return largest;
}

/// By displacement, darker where the surface turns away from the light.
std::string colour_of(const BodyShape& shape, const Triangle& t, double largest) {
  const double mean =
      (displacement(shape, t[0]) + displacement(shape, t[1]) + displacement(shape, t[2])) / 3.0;
  const double shade = 0.76 + 0.24 * std::max(0.0, dot(normal(shape.now_mm, t), kBodyLight));
  const auto channel = [&](std::size_t i) {
    return static_cast<int>(shade * (kStill[i] + mean / largest * (kFar[i] - kStill[i])));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", channel(0), channel(1), channel(2));
}

/// The table that the body stands on, if its lowest nodes have not moved.
void draw_table(const BodyShape& shape, Drawing& drawing) {
  constexpr double kRimMm = 16.0;
  Point3 low = {1e9, 1e9, 1e9};
  Point3 high = {-1e9, -1e9, -1e9};
  for (const Point3& p : shape.rest_mm) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  for (uint32_t i = 0; i < shape.rest_mm.size(); ++i) {
    if (shape.rest_mm[i][2] == low[2] && displacement(shape, i) > 1e-6) return;
  }
  const double z = low[2];
  drawing.add_polygon({{low[0] - kRimMm, low[1] - kRimMm, z},
                       {high[0] + kRimMm, low[1] - kRimMm, z},
                       {high[0] + kRimMm, high[1] + kRimMm, z},
                       {low[0] - kRimMm, high[1] + kRimMm, z}},
                      "fc rgb '#e4e7ea' fs solid 1.0 border rgb '#c3c9cf'");
}

void draw_surfaces(const BodyShape& shape, double largest, Drawing& drawing) {
  for (const std::size_t i : drawing.visible(shape, shape.rest_mm)) {
    const Triangle& t = shape.triangles[i];
    drawing.add_polygon({shape.rest_mm[t[0]], shape.rest_mm[t[1]], shape.rest_mm[t[2]]},
                        "fc rgb '#eef2f6' fs transparent solid 0.55 border rgb '#ccd5de' lw 0.4");
  }
  for (const std::size_t i : drawing.visible(shape, shape.now_mm)) {
    const Triangle& t = shape.triangles[i];
    drawing.add_polygon(
        {shape.now_mm[t[0]], shape.now_mm[t[1]], shape.now_mm[t[2]]},
        fmt::format("fc rgb '{}' fs solid 1.0 border rgb '#7d4a42' lw 0.5", colour_of(shape, t, largest)));
  }
}

/// About five steps of 1, 2 or 5 times a power of ten.
double tick_step(double range) {
  const double power = std::pow(10.0, std::floor(std::log10(range / 5.0)));
  const double digit = range / 5.0 / power;
  return power * (digit < 1.5 ? 1.0 : digit < 3.5 ? 2.0 : digit < 7.5 ? 5.0 : 10.0);
}

std::string plot_command(bool has_tool, double point_size) {
  std::string text =
      "plot NaN with points palette notitle, \\\n"
      "  keyentry with boxes fs transparent solid 0.55 border rgb '#ccd5de' fc rgb '#eef2f6' title 'at rest'";
  if (has_tool) {
    text += fmt::format(
        ", \\\n  $path with lines lc rgb '#08519c' lw 2 title 'path of the tool', \\\n"
        "  $tool with points pt 7 ps {} lc rgb '#08519c' title 'tool'",
        point_size);
  }
  return text + "\n";
}

}  // namespace

std::string body_picture_script(const Recording& recording) {
  const BodyShape& shape = recording.at_peak;
  const bool has_tool = (recording.all_flags & static_cast<uint32_t>(TickFlag::kGrasping)) != 0;
  const double largest = largest_displacement(shape);
  Drawing drawing(kTowardsBodyViewer);
  draw_table(shape, drawing);
  draw_surfaces(shape, largest, drawing);
  if (has_tool) {
    drawing.add_line("path", recording.tool_path_mm);
    drawing.add_line("tool", {recording.tool_at_peak_mm});
  }
  std::string text = drawing.script();
  text +=
      "set size ratio -1\nunset border\nunset tics\nset margins screen 0.01, screen 0.80, screen 0.01, "
      "screen 0.99\n";
  text += fmt::format("set palette defined (0 '#faeee1', 1 '#c41e32')\nset cbrange [0:{:.3f}]\n", largest);
  text += fmt::format("set cbtics {:g} format '%g' scale 0.5\n", tick_step(largest));
  text +=
      "set colorbox user origin screen 0.83, screen 0.08 size screen 0.03, screen 0.40\n"
      "set cblabel 'displacement, mm' offset 1.2, 0\n"
      "set key at screen 0.98, screen 0.97 right top Right samplen 1.5\n";
  text += fmt::format("set label 'peak force {:.1f} mN' at screen 0.965, screen 0.85 right\n",
                      recording.peak_force_n * 1e3);
  text += "set terminal svg size 720,760 font 'Helvetica,15' background '#ffffff'\nset output 'body.svg'\n" +
          plot_command(has_tool, 0.8) + "unset output\n";
  text +=
      "set terminal pngcairo size 1080,1140 font 'DejaVu Sans,16' linewidth 1.4\nset output 'body.png'\n" +
      plot_command(has_tool, 1.5) + "unset output\n";
  return text;
}

}  // namespace palpate::sim
