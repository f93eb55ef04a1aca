// The report's section on the criterion of the simulation front.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "output/gnuplot.hpp"
#include "output/output_file.hpp"
#include "paper/criterion_ranking.hpp"
#include "paper/sections.hpp"

namespace palpate::sim {
namespace {

constexpr std::array<const char*, 4> kRanked = {"six-edges", "longest-edge", "strain-jump", kUniformMesh};

std::string chart_file(const LoadStudy& study, StudyError which) {
  return fmt::format("criterion_{}_{}_{}.svg", study.load, study.finest_level,
                     which == StudyError::kMeanMm ? "mm" : "force");
}

Chart chart_of(const LoadStudy& study, StudyError which) {
  const bool is_force = which == StudyError::kForcePercent;
  Chart chart{chart_file(study, which),
              {"number of tets", true},
              {is_force ? "error of the force, %" : "mean error, mm", true,
               is_force ? Range{0.1, 1000.0} : Range{0.01, 10.0}},
              {},
              ChartSize::kHalf};
  for (const StudyCurve& curve : study.curves) {
    ChartPoints points;
    for (const StudyPoint& point : curve.points)
      points.push_back({point.tets, is_force ? point.force_percent : point.error.mean_mm});
    chart.series.push_back(
        {curve.criterion, points, SeriesStyle::kLineAndPoints, curve.criterion == kUniformMesh});
  }
  return chart;
}

Table table_of(const LoadStudy& study) {
  Table table{
      fmt::format("The {} at rest, finest level {}: distance from the uniform mesh of that level, over its "
                  "free nodes; time of the re-mesh stage a tick and tet.",
                  study.load, study.finest_level),
      {"criterion", "threshold", "tets", "mean error, mm", "largest, mm", "force, %", "run off its rest, mm",
       "re-mesh, ns a tick and tet"},
      {}};
  for (const StudyCurve& curve : study.curves) {
    for (const StudyPoint& point : curve.points) {
      table.rows.push_back(
          {{curve.criterion},
           {curve.criterion == kUniformMesh ? "–" : fmt::format("{:.3g}", point.threshold)},
           {fmt::format("{:.0f}", point.tets)},
           {fmt::format("{:.3f}", point.error.mean_mm), Mark::kOurs},
           {fmt::format("{:.3f}", point.error.max_mm)},
           {study.has_force ? fmt::format("{:.2f}", point.force_percent) : "–"},
           {curve.criterion == kUniformMesh ? "–" : fmt::format("{:.3f}", point.off_mm)},
           {curve.criterion == kUniformMesh ? "–" : fmt::format("{:.1f}", point.remesh_ns)}});
    }
  }
  return table;
}

void add_row(Table& table, const std::string& what, const std::string& from_to,
             const std::vector<RankedError>& order, const char* format) {
  std::vector<Cell> row = {{what}, {from_to}};
  row.reserve(kRanked.size() + 3);
  for (const char* name : kRanked) {
    const std::string text = fmt::format(fmt::runtime(format), error_of(order, name).error);
    row.push_back(name == default_criterion() ? Cell{text, Mark::kOurs} : Cell{text});
  }
  row.push_back({best_criterion(order).name});
  table.rows.push_back(row);
}

Table ranking_table(const std::vector<LoadStudy>& studies, Equal equal) {
  const bool is_time = equal == Equal::kTime;
  Table table{
      fmt::format("Errors at equal {}: geometric means over the range that all share, and their geometric "
                  "mean as a part of the uniform mesh's. The default stands out.",
                  is_time ? "times of a tick" : "numbers of tets"),
      {"load", is_time ? "us a tick" : "tets", kRanked[0], kRanked[1], kRanked[2], kRanked[3],
       "the best criterion"},
      {}};
  for (const LoadStudy& study : studies) {
    for (const StudyError which : errors_of(study)) {
      const Ranking ranking = rank(study, which, equal);
      const double unit = is_time ? 1e-3 : 1.0;
      add_row(table, name_of(study, which),
              fmt::format("{:.0f} to {:.0f}", unit * ranking.least, unit * ranking.most), ranking.order,
              which == StudyError::kMeanMm ? "{:.3f}" : "{:.1f}");
    }
  }
  add_row(table, "geometric mean, part of the uniform mesh's", "–", rank_all(studies, equal), "{:.3f}");
  return table;
}

Table loss_table(const std::vector<LoadStudy>& studies) {
  Table table{
      "Behind the best criterion, at equal tets or equal times, whichever is worse, and the time of the "
      "re-mesh stage a tick and tet.",
      {"criterion", "loss, %", "re-mesh, ns"},
      {}};
  for (const RankedError& loss : losses_of(studies)) {
    const Mark mark = loss.name == default_criterion() ? Mark::kOurs : Mark::kPlain;
    table.rows.push_back({{loss.name, mark},
                          {fmt::format("{:.0f}", 100.0 * (loss.error - 1.0)), mark},
                          {fmt::format("{:.0f}", remesh_ns_of(studies, loss.name)), mark}});
  }
  return table;
}

void write_criteria_csv(const std::vector<LoadStudy>& studies, const std::filesystem::path& path) {
  OutputFile file(path.string());
  file.print(
      "load,finest_level,criterion,threshold,tets,mean_error_mm,max_error_mm,force_error_percent,"
      "run_off_its_rest_mm,remesh_ns,tick_ns,command\n");
  for (const LoadStudy& study : studies) {
    for (const StudyCurve& curve : study.curves) {
      for (const StudyPoint& point : curve.points) {
        file.print("{},{},{},{:.3g},{:.0f},{:.6f},{:.6f},{:.4f},{:.6f},{:.2f},{:.2f},{}\n", study.load,
                   study.finest_level, curve.criterion, point.threshold, point.tets, point.error.mean_mm,
                   point.error.max_mm, point.force_percent, point.off_mm, point.remesh_ns, point.tick_ns,
                   point.command);
      }
    }
  }
  file.close();
}

}  // namespace

void add_criterion_section(const std::vector<LoadStudy>& studies, const Experiment& experiment,
                           ReportPage& page) {
  std::string charts;
  std::vector<Figure> figures;
  for (const LoadStudy& study : studies) {
    for (const StudyError which : errors_of(study)) {
      charts += chart_script(chart_of(study, which));
      figures.push_back({chart_file(study, which), name_of(study, which) + "."});
    }
  }
  run_gnuplot(charts, experiment.folder);
  write_criteria_csv(studies, experiment.folder / "criteria.csv");

  page.add_section("Which criterion refines the mesh");
  page.add_paragraph(
      "The mesh starts at level 3, is loaded, and comes to rest: the 90 degree bend, the corner pushed by "
      "50 mm, and the middle of a side pushed in by 20 mm with both ends held. The error is that of the "
      "equilibrium on the mesh that the run ends with, from the equilibrium on the uniform mesh of the "
      "finest level, both found by Newton's method in double precision, at the free nodes of the finest "
      "mesh; "
      "coarse meshes are interpolated. Thresholds are bisected until neighbouring meshes are within 50 % in "
      "tets or 3 % in threshold. The black curve is of uniform meshes: a criterion is worth its while below "
      "it; in its last point it has half of the finest mesh's tets, where the comparison ends. Around the "
      "driven node the mesh is always as fine as "
      "it may be. With the finest level 9 the density is 1000 kg/m3, for the sake of the step.");
  page.add_paragraph(conclusion_of(studies));
  page.add_table(loss_table(studies));
  page.add_table(ranking_table(studies, Equal::kTets));
  page.add_table(ranking_table(studies, Equal::kTime));
  page.add_figures(figures);
  for (const LoadStudy& study : studies) page.add_table(table_of(study));
}

}  // namespace palpate::sim
