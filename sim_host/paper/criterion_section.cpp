// The report's section on the criterion of the simulation front.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "output/gnuplot.hpp"
#include "output/output_file.hpp"
#include "paper/criterion_study.hpp"
#include "paper/sections.hpp"

namespace palpate::sim {
namespace {

constexpr const char* kDefault = "six-edges";
constexpr const char* kUniform = "uniform mesh";

std::string chart_file(const LoadStudy& study) {
  return fmt::format("criterion_{}_{}.svg", study.load, study.finest_level);
}

Chart chart_of(const LoadStudy& study) {
  Chart chart{
      chart_file(study), {"mean number of tets", true}, {"mean error, mm", true}, {}, ChartSize::kHalf};
  for (const StudyCurve& curve : study.curves) {
    ChartPoints points;
    for (const StudyPoint& point : curve.points) points.push_back({point.mean_tets, point.error.mean_mm});
    chart.series.push_back(
        {curve.criterion, points, SeriesStyle::kLineAndPoints, curve.criterion == kUniform});
  }
  return chart;
}

Table table_of(const LoadStudy& study) {
  Table table{
      fmt::format("The {} at rest, finest level {}: distance from the uniform mesh of that level, over its "
                  "free nodes.",
                  study.load, study.finest_level),
      {"criterion", "threshold", "tets, mean of the run", "tets at rest", "mean error, mm",
       "largest error, mm", "at rest"},
      {}};
  for (const StudyCurve& curve : study.curves) {
    for (const StudyPoint& point : curve.points) {
      table.rows.push_back({{curve.criterion},
                            {curve.criterion == kUniform ? "–" : fmt::format("{:g}", point.threshold)},
                            {fmt::format("{:.0f}", point.mean_tets)},
                            {fmt::format("{}", point.tets)},
                            {fmt::format("{:.3f}", point.error.mean_mm), Mark::kOurs},
                            {fmt::format("{:.3f}", point.error.max_mm)},
                            {point.is_at_rest ? "yes" : "not yet"}});
    }
  }
  return table;
}

/// Criteria by their error at the same number of tets, the best first.
struct Ranking {
  double tets;
  std::vector<std::pair<double, std::string>> order;  // mm, name
};

/// In the middle, in logarithms, of the numbers of tets that all adaptive curves have.
Ranking rank(const LoadStudy& study) {
  double least = 1.0;
  double most = 1e9;
  for (const StudyCurve& curve : study.curves) {
    if (curve.points.empty() || curve.criterion == kUniform) continue;
    least = std::max(least, curve.points.front().mean_tets);
    most = std::min(most, curve.points.back().mean_tets);
  }
  Ranking ranking{std::sqrt(least * std::max(least, most)), {}};
  for (const StudyCurve& curve : study.curves)
    ranking.order.emplace_back(error_at(curve, ranking.tets), curve.criterion);
  std::sort(ranking.order.begin(), ranking.order.end());
  return ranking;
}

std::string sentence(const LoadStudy& study, const Ranking& ranking) {
  std::vector<std::string> parts;
  for (const auto& [mm, name] : ranking.order) {
    parts.push_back(std::isfinite(mm) ? fmt::format("{} {:.3f} mm", name, mm) : fmt::format("{} -", name));
  }
  return fmt::format("{} to level {}, at {:.0f} tets: {}.", study.load, study.finest_level, ranking.tets,
                     fmt::join(parts, ", "));
}

void write_csv(const std::vector<LoadStudy>& studies, const std::filesystem::path& path) {
  OutputFile file(path.string());
  file.print(
      "load,finest_level,criterion,threshold,mean_tets,tets_at_rest,mean_error_mm,max_error_mm,is_at_rest,"
      "command\n");
  for (const LoadStudy& study : studies) {
    for (const StudyCurve& curve : study.curves) {
      for (const StudyPoint& point : curve.points) {
        file.print("{},{},{},{:g},{:.1f},{},{:.6f},{:.6f},{},{}\n", study.load, study.finest_level,
                   curve.criterion, point.threshold, point.mean_tets, point.tets, point.error.mean_mm,
                   point.error.max_mm, point.is_at_rest ? 1 : 0, point.command);
      }
    }
  }
  file.close();
}

}  // namespace

std::string conclusion_of(const std::vector<LoadStudy>& studies) {
  std::vector<std::string> lost;
  for (const LoadStudy& study : studies) {
    const Ranking ranking = rank(study);
    const auto best = std::find_if(ranking.order.begin(), ranking.order.end(),
                                   [](const auto& one) { return one.second != kUniform; });
    if (best->second == kDefault) continue;
    const auto own = std::find_if(ranking.order.begin(), ranking.order.end(),
                                  [](const auto& one) { return one.second == kDefault; });
    lost.push_back(fmt::format("{} to level {} ({} {:.3f} mm, {} {:.3f} mm)", study.load, study.finest_level,
                               best->second, best->first, kDefault, own->first));
  }
  if (lost.empty()) {
    return fmt::format("Conclusion: {}, the default, is the best of the three criteria for all {} loads.",
                       kDefault, studies.size());
  }
  return fmt::format(
      "Conclusion: the default, {}, is NOT the best of the three criteria for {} of {} loads: {}.", kDefault,
      lost.size(), studies.size(), fmt::join(lost, "; "));
}

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
  write_csv(studies, experiment.folder / "criteria.csv");

  page.add_section("Which criterion refines the mesh");
  page.add_paragraph(
      "The mesh starts at level 3, is loaded, and comes to rest: the 90 degree bend, the corner pushed by 50 "
      "mm, "
      "and the middle of a side pushed in by 20 mm with both ends held. The error is the distance from the "
      "equilibrium on the uniform mesh of the finest level, found by Newton's method in double precision, at "
      "its "
      "free nodes; a coarse mesh is interpolated. The black curve is of uniform meshes: a criterion is worth "
      "its "
      "while below it. With the finest level 9 the density is 1000 kg/m3, and a run may take 8 s.");
  page.add_paragraph(conclusion_of(studies));
  for (const LoadStudy& study : studies) page.add_paragraph(sentence(study, rank(study)));
  page.add_figures(figures);
  for (const LoadStudy& study : studies) page.add_table(table_of(study));
}

}  // namespace palpate::sim
