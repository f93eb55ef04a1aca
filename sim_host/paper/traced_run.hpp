// Runs of the program's own scenarios, recorded into run folders and kept in memory for what a report says of
// them. A request is what a user would type, so that any run of a report can be repeated.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "output/chart.hpp"
#include "simulation/simulation.hpp"

namespace palpate::sim {

/// Ticks between two points of a trace's end_mm.
inline constexpr uint32_t kEndEvery = 20;

struct RunRequest {
  std::string name;                                             // of its folder
  std::string scenario;                                         // a built-in one
  std::vector<std::pair<std::string, std::string>> parameters;  // keys and values of a scenario file
};

/// "palpate run cuboid-sine --theta 0.2".
std::string command_of(const RunRequest& request);
Scenario scenario_of(const RunRequest& request);

struct Trace {
  RunRequest request;
  // A value a tick.
  std::vector<std::array<double, 3>> force_n;
  std::vector<uint32_t> tets, rotation_tets;
  std::vector<double> remesh_ms;  // of the host, in the stage
  double all_ms = 0.0;            // of the host, in all stages and ticks
  ChartPoints end_mm;             // s, and how far the middle of the far end is along y
  BodyFields farthest, last;      // when the watched node was farthest, the last of several times; at the end
  Totals totals{};
  uint32_t all_flags = 0;
  std::optional<std::string> failure;

  [[nodiscard]] double peak_n() const;
  /// Time of the host a tick and tet: in the re-mesh stage, and in all stages.
  [[nodiscard]] double remesh_ns() const;
  [[nodiscard]] double tick_ns() const;
};

/// Runs it into `folder`/name, with a line on standard output when it is done.
Trace trace_run(const RunRequest& request, const std::filesystem::path& folder);

/// The same for several, on all cores, in the order of the requests.
std::vector<Trace> trace_runs(const std::vector<RunRequest>& requests, const std::filesystem::path& folder);

}  // namespace palpate::sim
