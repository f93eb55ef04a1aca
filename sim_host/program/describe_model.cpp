#include <fmt/format.h>

#include "output/output_file.hpp"
#include "program/commands.hpp"
#include "program/firmware_image.hpp"
#include "program/model_container.hpp"
#include "simulation/capacity.hpp"
#include "stability.hpp"

namespace palpate::sim {
namespace {

void print_mesh_changes(const Scenario& scenario) {
  const ModelParameters& model = scenario.model;
  if (!model.mesh_may_change()) {
    fmt::print("  mesh           stays as it is\n");
    return;
  }
  fmt::print("  mesh           is split where {} is above {:g}, merged below {:g}\n", scenario.stretch,
             model.remesh.stretch_split, model.remesh.stretch_merge_ratio * model.remesh.stretch_split);
}

void print_model(const Scenario& scenario, const Fit& fit) {
  const ModelParameters& model = scenario.model;
  fmt::print("{}: {} x {} x {} cubes of {:g} mm, level {}\n", scenario.name, model.cubes[0], model.cubes[1],
             model.cubes[2], model.edge_m * 1e3, model.level);
  fmt::print("  leaves         {}\n", fit.tets);
  fmt::print("  nodes          {}\n", fit.nodes);
  for (const RegionParameters& region : model.regions) {
    fmt::print("  material       E {:g} Pa, nu {:g}, rho {:g} kg/m3, levels {} to {}\n",
               region.youngs_modulus_pa, region.poisson_ratio, region.density_kg_m3, region.least_level,
               region.most_level);
  }
  print_mesh_changes(scenario);
  fmt::print("  critical step  {:.3f} ms\n", critical_step_s(model) * 1e3);
  fmt::print("  substeps       {} needed, {} chosen\n", needed_substeps(model), model.substeps);
  fmt::print("  state          {:.1f} KiB in profile {} ({:.1f} KiB with the device)\n",
             static_cast<double>(fit.state_bytes) / 1024.0, scenario.profile,
             static_cast<double>(fit.cycle_state_bytes) / 1024.0);
}

}  // namespace

int describe_model(Scenario scenario, const std::string& firmware_image_path,
                   const std::string& container_path) {
  complete_scenario(scenario);
  const Fit fit = fit_to_profile(scenario);
  if (firmware_image_path.empty() && container_path.empty()) print_model(scenario, fit);
  if (!firmware_image_path.empty()) write_whole_file(firmware_image_path, firmware_image_source(scenario));
  if (!container_path.empty()) write_whole_file(container_path, model_container(scenario));
  return 0;
}

}  // namespace palpate::sim
