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

std::string chart_file(const LoadStudy& study) {
  return fmt::format("criterion_{}_{}.svg", study.load, study.finest_level);
}

Chart chart_of(const LoadStudy& study) {
  Chart chart{chart_file(study),
              {"mean number of tets", true},
              {"mean error, mm", true, Range{0.01, 10.0}},
              {},
              ChartSize::kHalf};
  for (const StudyCurve& curve : study.curves) {
    ChartPoints points;
    for (const StudyPoint& point : curve.points) points.push_back({point.mean_tets, point.error.mean_mm});
    chart.series.push_back(
        {curve.criterion, points, SeriesStyle::kLineAndPoints, curve.criterion == kUniformMesh});
  }
  return chart;
}

Table table_of(const LoadStudy& study) {
  Table table{
      fmt::format("The {} at rest, finest level {}: distance from the uniform mesh of that level, over its "
                  "free nodes.",
                  study.load, study.finest_level),
      {"criterion", "threshold", "mean tets", "tets at rest", "mean error, mm", "largest, mm",
       "run off its rest, mm", "re-mesh, ns a tick and tet"},
      {}};
  for (const StudyCurve& curve : study.curves) {
    for (const StudyPoint& point : curve.points) {
      table.rows.push_back(
          {{curve.criterion},
           {curve.criterion == kUniformMesh ? "–" : fmt::format("{:g}", point.threshold)},
           {fmt::format("{:.0f}", point.mean_tets)},
           {fmt::format("{}", point.tets)},
           {fmt::format("{:.3f}", point.error.mean_mm), Mark::kOurs},
           {fmt::format("{:.3f}", point.error.max_mm)},
           {curve.criterion == kUniformMesh ? "–" : fmt::format("{:.3f}", point.off_mm)},
           {curve.criterion == kUniformMesh ? "–" : fmt::format("{:.1f}", point.remesh_ns)}});
    }
  }
  return table;
}

void add_row(Table& table, const std::string& load, const std::string& tets,
             const std::vector<RankedError>& order) {
  std::vector<Cell> row = {{load}, {tets}};
  row.reserve(kRanked.size() + 3);
  for (const char* name : kRanked) {
    const std::string text = fmt::format("{:.3f}", error_of(order, name).mm);
    row.push_back(name == default_criterion() ? Cell{text, Mark::kOurs} : Cell{text});
  }
  row.push_back({best_criterion(order).name});
  table.rows.push_back(row);
}

Table ranking_table(const std::vector<LoadStudy>& studies) {
  Table table{
      "Mean error at equal numbers of tets, mm: geometric mean over the range that the criteria share. The "
      "default stands out; the last row is the rule that chooses it.",
      {"load", "tets", kRanked[0], kRanked[1], kRanked[2], kRanked[3], "the best criterion"},
      {}};
  for (const LoadStudy& study : studies) {
    const Ranking ranking = rank(study);
    add_row(table, name_of(study), fmt::format("{:.0f} to {:.0f}", ranking.least_tets, ranking.most_tets),
            ranking.order);
  }
  add_row(table, "geometric mean", "–", rank_all(studies));
  return table;
}

void write_criteria_csv(const std::vector<LoadStudy>& studies, const std::filesystem::path& path) {
  OutputFile file(path.string());
  file.print(
      "load,finest_level,criterion,threshold,mean_tets,tets_at_rest,mean_error_mm,max_error_mm,run_off_its_"
      "rest_mm,"
      "remesh_ns,command\n");
  for (const LoadStudy& study : studies) {
    for (const StudyCurve& curve : study.curves) {
      for (const StudyPoint& point : curve.points) {
        file.print("{},{},{},{:g},{:.1f},{},{:.6f},{:.6f},{:.6f},{:.2f},{}\n", study.load, study.finest_level,
                   curve.criterion, point.threshold, point.mean_tets, point.tets, point.error.mean_mm,
                   point.error.max_mm, point.off_mm, point.remesh_ns, point.command);
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
    charts += chart_script(chart_of(study));
    figures.push_back(
        {chart_file(study), fmt::format("{}, finest level {}.", study.load, study.finest_level)});
  }
  run_gnuplot(charts, experiment.folder);
  write_criteria_csv(studies, experiment.folder / "criteria.csv");

  page.add_section("Which criterion refines the mesh");
  page.add_paragraph(
      "The mesh starts at level 3, is loaded, and comes to rest: the 90 degree bend, the corner pushed by "
      "50 mm, and the middle of a side pushed in by 20 mm with both ends held. The error is that of the "
      "equilibrium on the mesh that the run ends with, from the equilibrium on the uniform mesh of the "
      "finest "
      "level, both found by Newton's method in double precision, at the free nodes of the finest mesh; "
      "coarse "
      "meshes are interpolated. The number of tets is the mean over the run. The black curve is of uniform "
      "meshes: a criterion is worth its while below it. Around the driven node the mesh is always as fine as "
      "it may be. With the finest level 9 the density is 1000 kg/m3, for the sake of the step.");
  page.add_paragraph(conclusion_of(studies));
  page.add_table(ranking_table(studies));
  page.add_figures(figures);
  for (const LoadStudy& study : studies) page.add_table(table_of(study));
}

}  // namespace palpate::sim
