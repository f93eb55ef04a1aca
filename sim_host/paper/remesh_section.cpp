// How long re-meshing takes, and what both fronts do in the meantime.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "output/gnuplot.hpp"
#include "output/output_file.hpp"
#include "paper/mesh_picture.hpp"
#include "paper/sections.hpp"

namespace palpate::sim {
namespace {

struct StageTime {
  double mean_ms, median_ms, high_ms, max_ms;  // high: not exceeded in 99 % of the ticks
};

StageTime time_of(std::vector<double> ms) {
  constexpr double kPart = 0.99;
  if (ms.empty()) return {0.0, 0.0, 0.0, 0.0};
  const double mean = std::accumulate(ms.begin(), ms.end(), 0.0) / static_cast<double>(ms.size());
  std::sort(ms.begin(), ms.end());
  return {mean, ms[ms.size() / 2], ms[static_cast<std::size_t>(kPart * static_cast<double>(ms.size() - 1))],
          ms.back()};
}

std::vector<const Trace*> moving_runs(const PaperRuns& runs) {
  return {&runs.corner.on_chip_moving, &runs.indentation.on_chip_moving, &runs.corner.fine_moving,
          &runs.indentation.fine_moving};
}

Table times_table(const PaperRuns& runs) {
  constexpr const char* kPaperMs = "0.015";
  Table table{
      "Time in the re-mesh stage per tick of 1 ms, ms, and what it did: tets bisected and merged, rotation "
      "tets "
      "split and joined.",
      {"run", "the paper", "mean", "median", "99 % of ticks", "largest", "bisected", "merged", "split",
       "joined"},
      {}};
  const std::array<const char*, 4> titles = {"corner, on the chip", "side, on the chip", "corner, fine",
                                             "side, fine"};
  const std::vector<const Trace*> traces = moving_runs(runs);
  for (std::size_t i = 0; i < traces.size(); ++i) {
    const StageTime time = time_of(traces[i]->remesh_ms);
    const RemeshCounters& counters = traces[i]->totals.remesh;
    table.rows.push_back({{titles.at(i)},
                          {kPaperMs, Mark::kPaper},
                          {fmt::format("{:.4f}", time.mean_ms), Mark::kOurs},
                          {fmt::format("{:.4f}", time.median_ms)},
                          {fmt::format("{:.4f}", time.high_ms)},
                          {fmt::format("{:.3f}", time.max_ms)},
                          {fmt::format("{}", counters.bisected)},
                          {fmt::format("{}", counters.merged)},
                          {fmt::format("{}", counters.groups_split)},
                          {fmt::format("{}", counters.groups_joined)}});
  }
  return table;
}

Chart fronts_chart(const std::string& file, const Trace& trace) {
  constexpr double kMostTets = 1200.0;
  const auto over_time = [&](const char* column) {
    return CsvColumns{fmt::format("runs/{}/force.csv", trace.request.name), "column('time_ms')/1000",
                      fmt::format("column('{}')", column), 5};
  };
  return {file,
          {"time, s", false, Range{0.0, static_cast<double>(trace.tets.size()) * 1e-3}},
          {"number", false, Range{0.0, kMostTets}},
          {{"tets", over_time("tets")}, {"rotation tets", over_time("rotation_tets")}},
          ChartSize::kHalf};
}

void write_remesh_csv(const PaperRuns& runs, const std::filesystem::path& path) {
  OutputFile file(path.string());
  file.print("run,command,mean_ms,median_ms,p99_ms,max_ms\n");
  for (const Trace* trace : moving_runs(runs)) {
    const StageTime time = time_of(trace->remesh_ms);
    file.print("{},{},{:.6f},{:.6f},{:.6f},{:.6f}\n", trace->request.name, command_of(trace->request),
               time.mean_ms, time.median_ms, time.high_ms, time.max_ms);
  }
  file.close();
}

}  // namespace

void add_remesh_section(const PaperRuns& runs, const Experiment& experiment, ReportPage& page) {
  const std::vector<MeshPanel> panels = {{"corner, pulled by 50 mm", &runs.corner.on_chip_moving.farthest},
                                         {"corner, back at rest", &runs.corner.on_chip_moving.last},
                                         {"side, 20 mm", &runs.indentation.on_chip_moving.farthest},
                                         {"bend, uniform mesh", &runs.bend.last}};
  run_gnuplot(chart_script(fronts_chart("fronts_corner.svg", runs.corner.on_chip_moving)) +
                  chart_script(fronts_chart("fronts_indentation.svg", runs.indentation.on_chip_moving)) +
                  mesh_picture_script("meshes.svg", panels),
              experiment.folder);
  write_remesh_csv(runs, experiment.folder / "remesh_time.csv");

  page.add_section("Re-meshing while it runs");
  page.add_paragraph(
      "The paper gives 0.015 ms for each online re-mesh process, on a Core i7-2760QM at 2.4 GHz. Here is the "
      "time "
      "of the whole stage in a tick: the criteria of both fronts, and the changes. Runs on the chip's "
      "profile have "
      "this machine for themselves; the fine ones share it with another run. The largest tick of a run on a "
      "host "
      "also shows what else the host did.");
  page.add_table(times_table(runs));
  page.add_figures({{"fronts_corner.svg",
                     "Tets and rotation tets over time, profile cuboid-paper: corner of the free end."},
                    {"fronts_indentation.svg", "The same for the middle of a side with both ends held."}});
  page.add_figures(
      {{"meshes.svg",
        "Meshes of profile cuboid-paper; the first three change between levels 3 and 6. Darker: finer. "
        "Bold red lines separate tets that use different rotations."}});
}

}  // namespace palpate::sim
