// Runs a simulation to its end and writes what it does into a run folder.
#pragma once

#include <filesystem>
#include <functional>

#include "output/run_folder.hpp"
#include "simulation/simulation.hpp"

namespace palpate::sim {

/// What stays of a run for its summary and pictures.
struct Recording {
  Sample last{};
  uint32_t all_flags = 0;  // of any tick
  double peak_force_n = 0.0;
  uint64_t state_hash = 0;
  double duration_s = 0.0;
  BodyShape at_peak;  // when the watched node was farthest from its place
  std::array<double, 3> tool_at_peak_mm{};
  std::vector<std::array<double, 3>> tool_path_mm;
};

/// Writes force.csv, hash.csv and nodes.csv, and on request the series of .vtu files. `watch` sees every
/// tick. Throws Interrupted on Ctrl-C.
Recording record(Simulation& simulation, const Scenario& scenario, const RunFolder& folder,
                 const std::function<void(const Sample&)>& watch);

/// summary.json, see docs: version, scenario, what came out, parameters.
void write_summary(const Recording& recording, const Simulation& simulation, const Scenario& scenario,
                   const std::filesystem::path& path);

struct LinkRun;
/// The same of a firmware behind a link, as far as its console and the device know it.
void write_link_summary(const LinkRun& run, const Scenario& scenario, const std::filesystem::path& path);

/// Names of the set bits.
std::vector<std::string> flag_names(uint32_t flags);

}  // namespace palpate::sim
