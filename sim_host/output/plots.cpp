#include "output/plots.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "output/body_picture.hpp"
#include "output/gnuplot.hpp"

namespace palpate::sim {
namespace {

struct Curve {
  const char* column;
  const char* title;
  const char* style;
};

struct Chart {
  const char* file;
  const char* label;
  double scale;  // from the column's unit to the label's
  std::vector<Curve> curves;
};

// Colours that stay apart for colour-blind readers (Okabe and Ito).
constexpr const char* kX = "lines lc rgb '#0072b2' lw 1.5";
constexpr const char* kY = "lines lc rgb '#d55e00' lw 1.5";
constexpr const char* kZ = "lines lc rgb '#009e73' lw 1.5";

std::string chart_script(const Chart& chart, uint32_t ticks) {
  constexpr uint32_t kPoints = 2000;
  const uint32_t stride = std::max(1u, ticks / kPoints);
  std::string text = fmt::format("set output '{}'\nset ylabel '{}'\nplot ", chart.file, chart.label);
  const char* between = "";
  for (const Curve& curve : chart.curves) {
    text += fmt::format("{}'force.csv' using (column('time_ms')/1000):(({})*{}) every {} with {} title '{}'",
                        between, curve.column, chart.scale, stride, curve.style, curve.title);
    between = ", \\\n  ";
  }
  return text + "\nunset output\n";
}

std::string charts_script(const Recording& recording, bool has_device) {
  const std::string size = "sqrt(column('force_x_N')**2+column('force_y_N')**2+column('force_z_N')**2)";
  std::vector<Chart> charts = {{"force.svg",
                                has_device ? "force on the handle, mN" : "force of the tissue, mN",
                                1e3,
                                {{"column('force_x_N')", "x", kX},
                                 {"column('force_y_N')", "y", kY},
                                 {"column('force_z_N')", "z", kZ},
                                 {size.c_str(), "magnitude", "lines lc rgb '#000000' lw 2"}}},
                               {"displacement.svg",
                                "displacement of the node, mm",
                                1.0,
                                {{"column('displacement_x_mm')", "x", kX},
                                 {"column('displacement_y_mm')", "y", kY},
                                 {"column('displacement_z_mm')", "z", kZ}}}};
  if (has_device) {
    charts.push_back({"motor_codes.svg",
                      "motor code (2048: no current)",
                      1.0,
                      {{"column('motor_1_code')", "motor 1", kX},
                       {"column('motor_2_code')", "motor 2", kY},
                       {"column('motor_3_code')", "motor 3", kZ}}});
  }
  std::string text =
      fmt::format("set xrange [0:{}]\n", recording.last.tick * 1e-3) +
      "set terminal svg size 900,420 font 'Helvetica,15' background '#ffffff'\n"
      "set datafile separator ','\nset xlabel 'time, s'\nset grid lc rgb '#d8d8d8' lw 1\n"
      "set key outside right top Left reverse samplen 1.5\nset border 3 lc rgb '#606060'\nset tics nomirror\n"
      "set offsets 0, 0, graph 0.05, graph 0.05\nset lmargin 10\nset bmargin 3.5\n";
  for (const Chart& chart : charts) text += chart_script(chart, recording.last.tick);
  return text;
}

}  // namespace

void draw_plots(const Recording& recording, bool has_device, const RunFolder& folder) {
  run_gnuplot(charts_script(recording, has_device), folder.temporary());
  run_gnuplot(body_picture_script(recording), folder.temporary());
}

}  // namespace palpate::sim
