#include "sample_report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "output/chart.hpp"
#include "output/gnuplot.hpp"

namespace palpate::test {
namespace {

using sim::Mark;
using sim::SeriesStyle;

sim::Chart error_chart() {
  const sim::ChartPoints paper = {{18, 1.107}, {48, .367},  {300, .064}, {578, .032},
                                  {696, .020}, {908, .019}, {1072, .007}};
  const sim::ChartPoints ours = {{18, .856},  {58, .366},  {96, .254},  {316, .065},
                                 {470, .029}, {576, .008}, {696, .005}, {1152, 0}};
  const sim::ChartPoints best = {{48, .380},  {100, .186},  {200, .109},  {300, .046},
                                 {400, .021}, {578, .0044}, {696, .0013}, {908, .0001}};
  return {"error.svg",
          {"rotation tets"},
          {"mean error, mm", true},
          {{"the paper", paper, SeriesStyle::kPoints, true},
           {"skew", ours, SeriesStyle::kLineAndPoints},
           {"search's best_set", best, SeriesStyle::kLineAndPoints}},
          sim::ChartSize::kHalf};
}

sim::StackedBars stage_chart() {
  return {"stages.svg",
          "theta, deg",
          "time a tick, ms",
          {"25.8, coarse", "8.1", "4.1", "2.6", "1.8", "0.9", "0.1"},
          {{"rotations", {.02, .03, .07, .12, .14, .19, .22}},
           {"forces", {.36, .36, .37, .36, .36, .37, .36}},
           {"integrate", {.05, .05, .05, .05, .05, .05, .05}},
           {"touch and reaction", {.01, .01, .01, .01, .01, .01, .01}}},
          sim::ChartSize::kHalf};
}

sim::ChartPoints sine(double newtons) {
  sim::ChartPoints points;
  for (int k = 0; k <= 5000; k += 20) {
    const double s = std::sin(0.072 * k * M_PI / 180.0);
    points.push_back({k * 1e-3, 1e3 * newtons * (s - 0.25 * s * s)});
  }
  return points;
}

sim::Chart force_chart() {
  return {
      "force.svg",
      {"time, s", false, sim::Range{0.0, 5.0}},
      {"force, mN"},
      {{"linear", sine(.032)}, {"StVK", sine(.0654)}, {"corotated", sine(.0499), SeriesStyle::kLine, true}}};
}

sim::Table table() {
  const auto row = [](const char* theta, const char* tets, const char* paper, const char* ours, Mark mark,
                      const char* verdict) {
    return std::vector<sim::Cell>{
        {theta}, {tets}, {paper, Mark::kPaper}, {ours, Mark::kOurs}, {verdict, mark}};
  };
  return {"Mean distance from full corotation on a 90 degree arc, by the threshold of the rotation front.",
          {"theta, deg", "rotation tets", "the paper, mm", "here, mm", "verdict"},
          {row("25.8", "18", "1.107", "0.856", Mark::kHolds, "at most 1.107"),
           row("8.1", "58", "0.367", "0.366", Mark::kHolds, "at most 0.367"),
           row("4.1", "316", "0.064", "0.065", Mark::kGoalMissed, "0.064"),
           row("2.6", "470", "0.032", "0.029", Mark::kGoalMet, "0.032"),
           row("0.1", "1152", "0.007", "–", Mark::kFails, "converges & <stays>")}};
}

}  // namespace

void draw_sample_charts(const std::filesystem::path& folder) {
  sim::run_gnuplot(chart_script(error_chart()) + chart_script(stage_chart()) + chart_script(force_chart()),
                   folder);
}

void fill_sample_report(sim::ReportPage& page) {
  page.add_section("Rotations on a coarser front");
  page.add_paragraph(
      "Rotations are extracted on the rotation front only; all tets below use their ancestor's. The finer "
      "the "
      "threshold theta, the more tets extract one, and the nearer the shape is to that of full corotation. R "
      "< R' & "
      "so on are written as they are.");
  page.add_table(table());
  page.add_figures(
      {{"error.svg", "Mean error over the number of rotation tets; the best found is by search."},
       {"stages.svg", "Time a tick by stage over the threshold, on the host."}});
  page.add_section("Force at a driven corner");
  page.add_paragraph("The corner of the free end follows a sine of 50 mm, the other end is held.");
  page.add_figures({{"force.svg", "Force of the tissue on the tool for three models of elasticity."}});
  page.add_table({"Peak forces.",
                  {"model", "the paper, mN", "here, mN"},
                  {{{"linear"}, {"32", Mark::kPaper}, {"32.0", Mark::kOurs}},
                   {{"St. Venant-Kirchhoff"}, {"65.4", Mark::kPaper}, {"65.4", Mark::kOurs}},
                   {{"corotated"}, {"49.9", Mark::kPaper}, {"50.1", Mark::kOurs}}}});
}

}  // namespace palpate::test
