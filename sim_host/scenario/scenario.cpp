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

}  // namespace

const std::vector<std::string>& scenario_names() {
  static const std::vector<std::string> names = {"cuboid-bend", "cuboid-sine", "grasp"};
  return names;
}

const char* kind_name(ScenarioKind kind) {
  switch (kind) {
    case ScenarioKind::kSine:
      return "cuboid-sine";
    case ScenarioKind::kBend:
      return "cuboid-bend";
    default:
      return "grasp";
  }
}

Scenario built_in_scenario(const std::string& name) {
  Scenario scenario;
  scenario.name = name;
  scenario.model.level = Scenario::kAutomaticLevel;
  for (const ScenarioKind kind : {ScenarioKind::kSine, ScenarioKind::kBend, ScenarioKind::kGrasp}) {
    if (name != kind_name(kind)) continue;
    scenario.kind = kind;
    if (kind == ScenarioKind::kBend) scenario.hold = "both";
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

}  // namespace palpate::sim
