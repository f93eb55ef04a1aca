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
  Chart chart{chart_file(study),
              {"mean number of tets", true},
              {"mean error, mm", true, Range{0.01, 10.0}},
              {},
              ChartSize::kHalf};
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
      {"criterion", "threshold", "mean tets", "tets at rest", "mean error, mm", "largest, mm",
       "run off its rest, mm"},
      {}};
  for (const StudyCurve& curve : study.curves) {
    for (const StudyPoint& point : curve.points) {
      table.rows.push_back({{curve.criterion},
                            {curve.criterion == kUniform ? "–" : fmt::format("{:g}", point.threshold)},
                            {fmt::format("{:.0f}", point.mean_tets)},
                            {fmt::format("{}", point.tets)},
                            {fmt::format("{:.3f}", point.error.mean_mm), Mark::kOurs},
                            {fmt::format("{:.3f}", point.error.max_mm)},
                            {curve.criterion == kUniform ? "–" : fmt::format("{:.3f}", point.off_mm)}});
    }
  }
  return table;
}

/// Criteria by their error at the same number of tets, the best first: geometric mean over the numbers that
/// the curves share.
struct Ranking {
  double least_tets, most_tets;
  std::vector<std::pair<double, std::string>> order;  // mm, name
};

/// A criterion that never refines shares nothing and has the error of its last point everywhere.
void find_range(const LoadStudy& study, Ranking& ranking) {
  constexpr double kNoLimit = 1e9;
  ranking.least_tets = 1.0;
  ranking.most_tets = kNoLimit;
  for (const StudyCurve& curve : study.curves) {
    if (curve.criterion != kUniform)
      ranking.least_tets = std::max(ranking.least_tets, curve.points.front().mean_tets);
  }
  for (const StudyCurve& curve : study.curves) {
    const double last = curve.points.back().mean_tets;
    if (curve.criterion != kUniform && last > ranking.least_tets)
      ranking.most_tets = std::min(ranking.most_tets, last);
  }
  if (ranking.most_tets == kNoLimit) ranking.most_tets = ranking.least_tets;
}

double mean_error(const StudyCurve& curve, const Ranking& ranking) {
  constexpr int kSamples = 21;
  double sum = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const double part = static_cast<double>(i) / (kSamples - 1);
    const double tets = ranking.least_tets * std::pow(ranking.most_tets / ranking.least_tets, part);
    sum += std::log(error_at(curve, tets)) / kSamples;
  }
  return std::exp(sum);
}

Ranking rank(const LoadStudy& study) {
  Ranking ranking{};
  find_range(study, ranking);
  for (const StudyCurve& curve : study.curves)
    ranking.order.emplace_back(mean_error(curve, ranking), curve.criterion);
  std::sort(ranking.order.begin(), ranking.order.end());
  return ranking;
}

std::string name_of(const LoadStudy& study) {
  return fmt::format("{} to level {}", study.load, study.finest_level);
}

Table ranking_table(const std::vector<LoadStudy>& studies) {
  Table table{
      "Mean error at equal numbers of tets, mm: geometric mean over the range that the criteria share.",
      {"load", "tets", "six-edges", "longest-edge", "strain-jump", "uniform mesh", "the best criterion"},
      {}};
  for (const LoadStudy& study : studies) {
    const Ranking ranking = rank(study);
    const auto error_of = [&](const std::string& name) {
      const auto found = std::find_if(ranking.order.begin(), ranking.order.end(),
                                      [&](const auto& one) { return one.second == name; });
      return fmt::format("{:.3f}", found->first);
    };
    const auto best = std::find_if(ranking.order.begin(), ranking.order.end(),
                                   [](const auto& one) { return one.second != kUniform; });
    table.rows.push_back({{name_of(study)},
                          {fmt::format("{:.0f} to {:.0f}", ranking.least_tets, ranking.most_tets)},
                          {error_of("six-edges"), Mark::kOurs},
                          {error_of("longest-edge")},
                          {error_of("strain-jump")},
                          {error_of(kUniform)},
                          {best->second}});
  }
  return table;
}

void write_csv(const std::vector<LoadStudy>& studies, const std::filesystem::path& path) {
  OutputFile file(path.string());
  file.print(
      "load,finest_level,criterion,threshold,mean_tets,tets_at_rest,mean_error_mm,max_error_mm,run_off_its_"
      "rest_mm,"
      "command\n");
  for (const LoadStudy& study : studies) {
    for (const StudyCurve& curve : study.curves) {
      for (const StudyPoint& point : curve.points) {
        file.print("{},{},{},{:g},{:.1f},{},{:.6f},{:.6f},{:.6f},{}\n", study.load, study.finest_level,
                   curve.criterion, point.threshold, point.mean_tets, point.tets, point.error.mean_mm,
                   point.error.max_mm, point.off_mm, point.command);
      }
    }
  }
  file.close();
}

}  // namespace

std::string conclusion_of(const std::vector<LoadStudy>& studies) {
  constexpr double kTie = 1.05;
  std::vector<std::string> lost;
  std::vector<std::string> useless;
  for (const LoadStudy& study : studies) {
    const Ranking ranking = rank(study);
    const auto is_criterion = [](const auto& one) { return one.second != kUniform; };
    const auto is_default = [](const auto& one) { return one.second == kDefault; };
    const auto best = std::find_if(ranking.order.begin(), ranking.order.end(), is_criterion);
    const auto own = std::find_if(ranking.order.begin(), ranking.order.end(), is_default);
    if (best != ranking.order.begin()) useless.push_back(name_of(study));
    if (own->first <= kTie * best->first) continue;
    lost.push_back(fmt::format("{} ({} {:.3f} mm, {} {:.3f} mm)", name_of(study), best->second, best->first,
                               kDefault, own->first));
  }
  std::string text = fmt::format(
      "Conclusion: the default, {}, is the best of the three criteria, or within 5 % of it, for {} of {} "
      "loads",
      kDefault, studies.size() - lost.size(), studies.size());
  if (!lost.empty()) text += fmt::format(", and NOT for {}", fmt::join(lost, "; "));
  if (!useless.empty())
    text += fmt::format(". A uniform mesh beats all three for {}", fmt::join(useless, "; "));
  return text + ".";
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
