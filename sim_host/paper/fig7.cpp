// Fig. 7 of the paper. It prints curves without numbers, so the numbers beside ours are those of another
// implementation in double precision (static solutions on the same mesh).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "output/gnuplot.hpp"
#include "output/output_file.hpp"
#include "output/projection.hpp"
#include "paper/mesh_error.hpp"
#include "paper/mesh_picture.hpp"
#include "paper/sections.hpp"
#include "paper/smoothness.hpp"

namespace palpate::sim {
namespace {

constexpr uint32_t kPointEvery = 20;  // ticks

using Forces = std::vector<std::array<double, 3>>;

struct Curve {
  std::string title;
  std::string of_study_mn;  // peak of the force
  const Forces* force_n;
  const ChartPoints* end_mm;
  const BodyFields* farthest;
  const Trace* trace;  // nullptr for the reference's models
};

std::vector<Curve> curves_of(const PaperRuns& runs) {
  const auto of_core = [](const std::string& title, const std::string& study, const Trace& trace) {
    return Curve{title, study, &trace.force_n, &trace.end_mm, &trace.farthest, &trace};
  };
  const auto of_model = [](const std::string& title, const std::string& study, const ModelTrace& trace) {
    return Curve{title, study, &trace.force_n, &trace.end_mm, &trace.farthest, nullptr};
  };
  return {of_model("L-FEM", "32", runs.linear), of_model("NL-FEM (StVK)", "65.4", runs.st_venant_kirchhoff),
          of_core("full corotation", "49.9", runs.corner.full),
          of_core("adaptive, 1.5 deg", "–", runs.corner_default),
          of_core("adaptive, on the chip", "–", runs.corner.on_chip)};
}

double peak_mn(const Forces& force_n) {
  double peak = 0.0;
  for (const Point3& force : force_n) peak = std::max(peak, 1e3 * length(force));
  return peak;
}

/// Of the axis: a round number above all.
double highest_mn(const std::vector<Curve>& curves) {
  constexpr double kStep = 10.0;
  double highest = 0.0;
  for (const Curve& curve : curves) highest = std::max(highest, peak_mn(*curve.force_n));
  return kStep * (std::floor(highest / kStep) + 1.0);
}

std::string distance_from(const Curve& curve, const Trace& full) {
  if (curve.trace == &full) return "–";
  const std::vector<bool> all(full.farthest.rest_mm.size(), true);
  return fmt::format("{:.3f}", error_of(*curve.farthest, full.farthest, all).mean_mm);
}

Table peaks_table(const std::vector<Curve>& curves, const Trace& full) {
  Table table{"Peak of the force on the tool, and the shape at the peak, mean over all nodes.",
              {"model", "rotation tets", "independent, mN", "here, mN", "distance from full corotation, mm"},
              {}};
  for (const Curve& curve : curves) {
    const std::string groups =
        curve.trace == nullptr ? "–" : fmt::format("{}", curve.trace->totals.rotation_tets.peak);
    table.rows.push_back({{curve.title},
                          {groups},
                          {curve.of_study_mn},
                          {fmt::format("{:.1f}", peak_mn(*curve.force_n)), Mark::kOurs},
                          {distance_from(curve, full)}});
  }
  return table;
}

Chart chart_of(const std::string& file, const Axis& y, const std::vector<Curve>& curves, double end_s,
               ChartPoints (*points_of)(const Curve&)) {
  Chart chart{file, {"time, s", false, Range{0.0, end_s}}, y, {}};
  for (const Curve& curve : curves) {
    Series series{curve.title, points_of(curve)};
    series.is_main = curve.title == "full corotation";
    chart.series.push_back(series);
  }
  return chart;
}

void write_curves_csv(const std::vector<Curve>& curves, const std::filesystem::path& path) {
  OutputFile file(path.string());
  file.print("time_s,model,force_mN,end_y_mm\n");
  for (const Curve& curve : curves) {
    for (const auto& [time_s, end_mm] : *curve.end_mm) {
      const auto tick = static_cast<std::size_t>(std::lround(time_s * 1e3));
      file.print("{:.3f},{},{:.5f},{:.5f}\n", time_s, curve.title, 1e3 * length((*curve.force_n)[tick - 1]),
                 end_mm);
    }
  }
  file.close();
}

}  // namespace

void add_fig7_sections(const PaperRuns& runs, const Experiment& experiment, ReportPage& page) {
  const std::vector<Curve> curves = curves_of(runs);
  const double end_s = static_cast<double>(runs.corner.full.force_n.size()) * 1e-3;
  const std::string charts =
      chart_script(chart_of("fig7a.svg", Axis{"y of the free end's middle, mm"}, curves, end_s,
                            [](const Curve& curve) { return *curve.end_mm; })) +
      chart_script(
          chart_of("fig7b.svg", Axis{"force, mN", false, Range{0.0, highest_mn(curves)}}, curves, end_s,
                   [](const Curve& curve) { return magnitude_over_time(*curve.force_n, kPointEvery); })) +
      mesh_picture_script("fig7_shapes.svg",
                          {{"L-FEM", &runs.linear.farthest, false},
                           {"NL-FEM (StVK)", &runs.st_venant_kirchhoff.farthest, false},
                           {"full corotation", &runs.corner.full.farthest, false},
                           {"adaptive, on the chip", &runs.corner.on_chip.farthest, true}});
  run_gnuplot(charts, experiment.folder);
  write_curves_csv(curves, experiment.folder / "fig7.csv");

  page.add_section("Figure 7: deformation and reaction force");
  page.add_paragraph(
      "One end of the bar is held; a corner of the other follows u = (0, 50 sin(0.072 k), 0) mm, k in "
      "ticks of 1 ms and the angle in degrees, over two periods, with rho = 10 kg/m3 and 4 substeps. The "
      "core is fixed point; L-FEM and NL-FEM are stepped in double precision with the same substeps and "
      "damping, which is stable for both. \"On the chip\" is profile cuboid-paper as it is by default, "
      "theta = 1.5 degrees and at most 48 rotation tets.");
  page.add_paragraph(
      "The paper prints its Figure 7 without numbers. The peaks beside ours are static solutions by another "
      "implementation in double precision on the same mesh.");
  page.add_figures(
      {{"fig7a.svg", "Fig. 7a: how far the middle of the free end is carried along by its corner."}});
  page.add_figures({{"fig7b.svg", "Fig. 7b: magnitude of the force of the tissue on the tool."}});
  page.add_figures(
      {{"fig7_shapes.svg",
        "The bar at the peak of the pull. Colours are levels of the mesh; bold red lines separate tets "
        "that use different rotations."}});
  page.add_table(peaks_table(curves, runs.corner.full));
}

}  // namespace palpate::sim
