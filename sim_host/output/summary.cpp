// summary.json.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "output/output_file.hpp"
#include "output/recorder.hpp"
#include "palpate/tick/state.hpp"
#include "scenario/parameter_table.hpp"

namespace palpate::sim {
namespace {

using Json = nlohmann::ordered_json;

/// Host time, the only thing here that differs from run to run.
Json stage_times(const Simulation& simulation, uint32_t ticks) {
  Json times;
  const std::vector<std::string> names = simulation.hash_names();
  const std::vector<double> spent = simulation.stage_ms();
  for (std::size_t i = 0; i < spent.size(); ++i) times[names[i]] = spent[i] / std::max(ticks, 1u);
  return times;
}

Json parameters_of(const Scenario& scenario) {
  Json parameters;
  for (const Parameter& parameter : parameter_table()) {
    const bool belongs = (parameter.kinds & kind_bit(scenario.kind)) != 0;
    if (belongs && !parameter.is_output) parameters[parameter.key] = parameter_value(parameter, scenario);
  }
  if (scenario.model.regions.size() > 1) {
    for (const char* key :
         {"youngs_modulus_pa", "poisson_ratio", "density_kg_m3", "least_level", "most_level"}) {
      parameters.erase(key);
    }
    for (const RegionParameters& region : scenario.model.regions) {
      parameters["region"].push_back(Json{{"youngs_modulus_pa", region.youngs_modulus_pa},
                                          {"poisson_ratio", region.poisson_ratio},
                                          {"density_kg_m3", region.density_kg_m3},
                                          {"least_level", region.least_level},
                                          {"most_level", region.most_level}});
    }
  }
  return parameters;
}

}  // namespace

std::vector<std::string> flag_names(uint32_t flags) {
  std::vector<std::string> names;
  const auto add = [&](TickFlag flag, const char* name) {
    if ((flags & static_cast<uint32_t>(flag)) != 0) names.emplace_back(name);
  };
  add(TickFlag::kSpeedClamped, "speed_clamped");
  add(TickFlag::kPositionClamped, "position_clamped");
  add(TickFlag::kStrainClamped, "strain_clamped");
  add(TickFlag::kGrasping, "grasping");
  add(TickFlag::kPatchBudget, "patch_budget");
  add(TickFlag::kRotationBudget, "rotation_budget");
  add(TickFlag::kLeavesFull, "leaves_full");
  add(TickFlag::kNodesFull, "nodes_full");
  add(TickFlag::kGroupsFull, "groups_full");
  add(TickFlag::kTethersFull, "tethers_full");
  return names;
}

void write_summary(const Recording& recording, const Simulation& simulation, const Scenario& scenario,
                   const std::filesystem::path& path) {
  const Totals totals = simulation.totals();
  Json summary;
  summary["version"] = PALPATE_VERSION;
  summary["scenario"] = scenario.name;
  summary["profile"] = scenario.profile;
  summary["ticks"] = recording.last.tick;
  summary["tets"] = totals.tets.used;
  summary["nodes"] = totals.nodes.used;
  summary["rotation_tets"] = totals.rotation_tets.used;
  summary["peaks"] = {{"tets", totals.tets.peak},
                      {"nodes", totals.nodes.peak},
                      {"rotation_tets", totals.rotation_tets.peak},
                      {"tethers", totals.tethers.peak}};
  summary["changes"] = {{"tets_bisected", totals.remesh.bisected},
                        {"tets_merged", totals.remesh.merged},
                        {"rotation_tets_split", totals.remesh.groups_split},
                        {"rotation_tets_joined", totals.remesh.groups_joined}};
  summary["peak_force_N"] = recording.peak_force_n;
  summary["state_hash"] = fmt::format("{:016x}", recording.state_hash);
  summary["flags"] = flag_names(recording.all_flags);
  summary["clamps"] = {
      {"speed", totals.clamps.speed}, {"position", totals.clamps.position}, {"strain", totals.clamps.strain}};
  summary["host_ms_a_tick"] = stage_times(simulation, recording.last.tick);
  summary["failure"] = simulation.failure() ? Json(*simulation.failure()) : Json(nullptr);
  summary["parameters"] = parameters_of(scenario);
  const std::string text = summary.dump(2) + "\n";
  OutputFile file(path.string());
  file.write(text.data(), text.size());
  file.close();
}

}  // namespace palpate::sim
