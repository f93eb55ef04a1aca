// summary.json.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "hil/link_run.hpp"
#include "output/output_file.hpp"
#include "output/recorder.hpp"
#include "palpate/tick/state.hpp"
#include "scenario/parameter_table.hpp"

namespace palpate::sim {
namespace {

using Json = nlohmann::ordered_json;

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

void write_json(const Json& json, const std::filesystem::path& path) {
  write_whole_file(path.string(), json.dump(2) + "\n");
}

/// How hand and tool hang together.
Json device_of(const SceneParameters& scene) {
  const std::array<double, 9> r = device_rotation(scene);
  Json device;
  device["rotation"] = {{r[0], r[1], r[2]}, {r[3], r[4], r[5]}, {r[6], r[7], r[8]}};
  device["rotation_deg"] = scene.device_rotation_deg;
  device["body_centre_m"] = scene.body_centre_in_device_m;
  device["motion_scale"] = scene.motion_scale;
  device["force_scale"] = scene.force_scale;
  device["work_scale"] = scene.work_scale();
  return device;
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
  add(TickFlag::kTouching, "touching");
  add(TickFlag::kContactsFull, "contacts_full");
  add(TickFlag::kBraking, "braking");
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
  if (simulation.has_device()) summary["device"] = device_of(scenario.scene);
  summary["failure"] = simulation.failure() ? Json(*simulation.failure()) : Json(nullptr);
  summary["parameters"] = parameters_of(scenario);
  write_json(summary, path);
}

void write_link_summary(const LinkRun& run, const Scenario& scenario, const std::filesystem::path& path) {
  Json summary;
  summary["version"] = PALPATE_VERSION;
  summary["scenario"] = scenario.name;
  summary["profile"] = scenario.profile;
  summary["board"] = scenario.board;
  summary["link"] = scenario.link;
  summary["ticks"] = run.ticks;
  summary["peak_hand_force_N"] = run.peak_hand_force_n;
  summary["state_hash"] = run.state_hash;
  summary["safety_state"] = run.last_state;
  summary["device"] = device_of(scenario.scene);
  summary["parameters"] = parameters_of(scenario);
  write_json(summary, path);
}

}  // namespace palpate::sim
