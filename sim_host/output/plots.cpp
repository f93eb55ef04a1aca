#include "output/plots.hpp"

#include <algorithm>

#include "output/body_picture.hpp"
#include "output/chart.hpp"
#include "output/gnuplot.hpp"

namespace palpate::sim {
namespace {

/// Columns of force.csv over time; a picture has fewer points than a long run has rows.
Series over_time(const char* title, const std::string& column, uint32_t ticks) {
  constexpr uint32_t kPoints = 2000;
  return Series{title,
                CsvColumns{"force.csv", "column('time_ms')/1000", column, std::max(1u, ticks / kPoints)}};
}

std::string charts_script(const Recording& recording, bool has_device) {
  const uint32_t ticks = recording.last.tick;
  const Axis time{"time, s", false, Range{0.0, ticks * 1e-3}};
  Series magnitude = over_time(
      "magnitude", "1e3*sqrt(column('force_x_N')**2+column('force_y_N')**2+column('force_z_N')**2)", ticks);
  magnitude.is_main = true;
  const Chart force{
      "force.svg",
      time,
      {has_device ? "force on the handle, mN" : "force of the tissue, mN"},
      {over_time("x", "1e3*column('force_x_N')", ticks), over_time("y", "1e3*column('force_y_N')", ticks),
       over_time("z", "1e3*column('force_z_N')", ticks), magnitude}};
  const Chart displacement{"displacement.svg",
                           time,
                           {"displacement of the node, mm"},
                           {over_time("x", "column('displacement_x_mm')", ticks),
                            over_time("y", "column('displacement_y_mm')", ticks),
                            over_time("z", "column('displacement_z_mm')", ticks)}};
  const Chart motor_codes{"motor_codes.svg",
                          time,
                          {"motor code (2048: no current)"},
                          {over_time("motor 1", "column('motor_1_code')", ticks),
                           over_time("motor 2", "column('motor_2_code')", ticks),
                           over_time("motor 3", "column('motor_3_code')", ticks)}};
  const std::string script = chart_script(force) + chart_script(displacement);
  return has_device ? script + chart_script(motor_codes) : script;
}

}  // namespace

void draw_plots(const Recording& recording, bool has_device, const RunFolder& folder) {
  run_gnuplot(charts_script(recording, has_device), folder.temporary());
  run_gnuplot(body_picture_script(recording), folder.temporary());
}

}  // namespace palpate::sim
