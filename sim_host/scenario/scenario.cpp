#include "scenario/scenario.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "scenario/scenario_file.hpp"

namespace palpate::sim {
namespace {

std::size_t longest_axis(const ModelParameters& model) {
  return static_cast<std::size_t>(std::max_element(model.cubes.begin(), model.cubes.end()) -
                                  model.cubes.begin());
}

/// A corner of the free end, low in x so that it is near to the device, and in y where the drag pulls it off
/// the body; with both ends held the middle of a side, low in y, the direction of the drive.
std::array<double, 3> default_node_mm(const Scenario& scenario) {
  const ModelParameters& model = scenario.model;
  const std::size_t axis = longest_axis(model);
  const double edge_mm = model.edge_m * 1e3;
  std::array<double, 3> node = {0.0, 0.0, 0.0};
  if (scenario.kind == ScenarioKind::kGrasp && scenario.grasp.drag_mm > 0.0)
    node[1] = model.cubes[1] * edge_mm;
  node[axis] = model.cubes[axis] * edge_mm;
  if (model.held == HeldEnds::kBoth) {
    for (std::size_t i = 0; i < 3; ++i) node[i] = model.cubes[i] * edge_mm / 2.0;
    node[axis == 1 ? 0 : 1] = 0.0;
  }
  return node;
}

HeldEnds held_ends(const std::string& hold) {
  if (hold == "none") return HeldEnds::kNone;
  return hold == "one" ? HeldEnds::kOne : HeldEnds::kBoth;
}

RotationCriterion rotation_criterion(const std::string& name) {
  if (name == "full") return RotationCriterion::kFull;
  return name == "siblings" ? RotationCriterion::kSiblings : RotationCriterion::kMisfit;
}

StretchCriterion stretch_criterion(const std::string& name) {
  if (name == "longest-edge") return StretchCriterion::kLongestEdge;
  if (name == "six-edges") return StretchCriterion::kSixEdges;
  return name == "strain-jump" ? StretchCriterion::kStrainJump : StretchCriterion::kFixed;
}

/// The paper's tissue gives 50 mN, which nobody feels. The body stands to the left of the tool in its reset
/// pose, 38 mm away; its low y side is touched, near the free end.
void set_soft_tissue(Scenario& scenario) {
  for (RegionParameters& region : scenario.model.regions) {
    region.youngs_modulus_pa = 20e3;
    region.density_kg_m3 = 1000.0;
  }
  scenario.model.mass_damping_per_s = 10.0;
  scenario.model.contact.tool_radius_m = 0.005;
  scenario.model.contact.slew_n_per_tick = 0.02;  // what a finger just feels
  scenario.scene.body_centre_in_device_m = {0.215, 0.07, -0.234};
  scenario.node_mm = {32.0, 0.0, 160.0};
  scenario.node_given = true;
}

}  // namespace

const std::vector<std::string>& scenario_names() {
  static const std::vector<std::string> names = {"cuboid-bend", "cuboid-sine", "grasp", "touch"};
  return names;
}

const char* kind_name(ScenarioKind kind) {
  switch (kind) {
    case ScenarioKind::kSine:
      return "cuboid-sine";
    case ScenarioKind::kBend:
      return "cuboid-bend";
    case ScenarioKind::kGrasp:
      return "grasp";
    default:
      return "touch";
  }
}

Scenario built_in_scenario(const std::string& name) {
  Scenario scenario;
  scenario.name = name;
  scenario.model.level = Scenario::kAutomaticLevel;
  scenario.model.substeps = Scenario::kAutomaticSubsteps;
  for (const ScenarioKind kind :
       {ScenarioKind::kSine, ScenarioKind::kBend, ScenarioKind::kGrasp, ScenarioKind::kTouch}) {
    if (name != kind_name(kind)) continue;
    scenario.kind = kind;
    if (kind == ScenarioKind::kBend) scenario.hold = "both";
    if (kind == ScenarioKind::kTouch) set_soft_tissue(scenario);
    return scenario;
  }
  throw BadInput(fmt::format("no scenario is called '{}'; choose {}, or a path that ends in .toml", name,
                             fmt::join(scenario_names(), ", ")));
}

Scenario load_scenario(const std::string& name_or_path) {
  const std::string ending = ".toml";
  const bool is_path = name_or_path.size() > ending.size() &&
                       name_or_path.compare(name_or_path.size() - ending.size(), ending.size(), ending) == 0;
  return is_path ? read_scenario_file(name_or_path) : built_in_scenario(name_or_path);
}

void complete_scenario(Scenario& scenario) {
  scenario.model.held = held_ends(scenario.hold);
  scenario.model.remesh.rotation = rotation_criterion(scenario.rotations);
  scenario.model.remesh.stretch = stretch_criterion(scenario.stretch);
  if (scenario.kind == ScenarioKind::kBend && scenario.hold != "both") {
    throw BadInput(fmt::format(
        "hold is '{}', but cuboid-bend turns the second of two held ends: it must be both", scenario.hold));
  }
  if (!scenario.node_given) scenario.node_mm = default_node_mm(scenario);
}

std::array<double, 3> node_from_centre_m(const Scenario& scenario) {
  std::array<double, 3> from_centre{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    from_centre[axis] =
        scenario.node_mm[axis] * 1e-3 - scenario.model.cubes[axis] * scenario.model.edge_m / 2.0;
  }
  return from_centre;
}

firmware::CycleModel cycle_model(const Scenario& scenario) {
  SceneParameters scene;
  scene.body_centre_in_device_m = {0.0, 0.0, 0.0};
  if (has_device(scenario.kind)) scene = scenario.scene;
  return {compile_model(scenario.model), compile_scene(scene, scenario.model)};
}

}  // namespace palpate::sim
