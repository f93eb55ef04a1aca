#include "output/recording_plots.hpp"

#include "output/chart.hpp"
#include "output/gnuplot.hpp"

namespace palpate::sim {
namespace {

/// Down and up in each bin, so that no spike is lost.
Series over_time(const char* title, const recording::Curves& curves,
                 const std::vector<recording::Span>& spans) {
  ChartPoints points;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    points.push_back({curves.time_s[i], static_cast<double>(spans[i].least)});
    if (spans[i].most != spans[i].least) {
      points.push_back({curves.time_s[i], static_cast<double>(spans[i].most)});
    }
  }
  return Series{title, points};
}

std::vector<std::string> state_names() {
  std::vector<std::string> names;
  for (uint32_t i = 0; i < safety::kStateCount; ++i) {
    names.emplace_back(safety::state_name(static_cast<safety::State>(i)));
  }
  return names;
}

}  // namespace

void draw_recording(const recording::Curves& curves, const std::filesystem::path& folder) {
  const Axis time{"time, s"};
  const Chart counts{
      "counts.svg",
      time,
      {"encoder counts"},
      {over_time("joint 1", curves, curves.counts[0]), over_time("joint 2", curves, curves.counts[1]),
       over_time("joint 3", curves, curves.counts[2])}};
  const Chart codes{
      "codes.svg",
      time,
      {"motor code (2048: no current)"},
      {over_time("motor 1", curves, curves.codes[0]), over_time("motor 2", curves, curves.codes[1]),
       over_time("motor 3", curves, curves.codes[2])}};
  const Chart state{"state.svg",
                    time,
                    {"", false, Range{0.0, safety::kStateCount - 1.0}, state_names()},
                    {over_time("safety layer", curves, curves.state)}};
  run_gnuplot(chart_script(counts) + chart_script(codes) + chart_script(state), folder);
}

}  // namespace palpate::sim
