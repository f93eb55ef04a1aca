#include "simulation/capacity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "palpate/firmware/cycle.hpp"
#include "simulation/with_profile.hpp"

namespace palpate::sim {
namespace {

constexpr int kDeepestAutomaticLevel = 6;
constexpr int kMostAutomaticSubsteps = 4;

int64_t tets_at(const ModelParameters& model, int level) {
  int64_t cubes = int64_t{model.cubes[0]} * model.cubes[1] * model.cubes[2];
  if (!model.region_of_cube.empty()) {
    cubes =
        std::count_if(model.region_of_cube.begin(), model.region_of_cube.end(), [](int r) { return r >= 0; });
  }
  return cubes * kRootsPerCube << level;
}

/// Whether the mesh fits at this level, however it may change later.
template <class Profile>
Status try_level(const Scenario& scenario, int level, State<Profile>& state) {
  ModelParameters at_level = scenario.model;
  at_level.level = level;
  for (RegionParameters& region : at_level.regions) region.least_level = region.most_level = kStartLevel;
  return start(state, compile_model(at_level));
}

/// An automatic level stays within what the regions allow.
template <class Profile>
int deepest_allowed(const ModelParameters& model) {
  int level = std::min<int>(kDeepestAutomaticLevel, Profile::kMaxLevel);
  for (const RegionParameters& region : model.regions) {
    if (region.most_level != kStartLevel) level = std::min(level, region.most_level);
  }
  return level;
}

template <class Profile>
int deepest_level(const Scenario& scenario, State<Profile>& state) {
  for (int level = deepest_allowed<Profile>(scenario.model); level >= 0; --level) {
    if (tets_at(scenario.model, level) > Profile::kLeaves) continue;
    if (try_level(scenario, level, state) == Status::kDone) return level;
  }
  return Scenario::kAutomaticLevel;
}

template <class Profile>
[[noreturn]] void refuse(const Scenario& scenario, State<Profile>& state) {
  const int deepest = deepest_level(scenario, state);
  if (deepest == Scenario::kAutomaticLevel) {
    throw BadInput(fmt::format("{} cubes do not fit profile {} even at level 0: take a larger profile",
                               tets_at(scenario.model, 0) / kRootsPerCube, Profile::kName));
  }
  throw BadInput(
      fmt::format("level {} of this block has {} tets, but profile {} holds {} tets and {} nodes down to "
                  "level {}: take level {} or "
                  "less, or a larger profile",
                  scenario.model.level, tets_at(scenario.model, scenario.model.level), Profile::kName,
                  Profile::kLeaves, Profile::kNodes, Profile::kMaxLevel, deepest));
}

template <class Profile>
void require_levels_of_profile(const ModelParameters& model) {
  for (std::size_t i = 0; i < model.regions.size(); ++i) {
    const int most = model.regions[i].most_level;
    if (most <= Profile::kMaxLevel) continue;
    throw BadInput(fmt::format(
        "{}most_level is {}, but profile {} goes down to level {}: take most_level {} or less, or a larger "
        "profile",
        place_of_region(model, i), most, Profile::kName, Profile::kMaxLevel, Profile::kMaxLevel));
  }
}

template <class Profile>
void require_substeps_of_profile(const ModelParameters& model) {
  const auto most = static_cast<int>(Profile::kSubsteps);
  if (model.substeps <= most) return;
  const char* or_less = most > 1 ? " or less" : "";
  throw BadInput(
      fmt::format("substeps is {}, but profile {} computes at most {} a tick: take substeps {}{} and what "
                  "makes that stable "
                  "(density_kg_m3 up, youngs_modulus_pa or level down), or another profile",
                  model.substeps, Profile::kName, most, most, or_less));
}

template <class Profile>
void require_criteria_of_profile(const ModelParameters& model) {
  if constexpr (Profile::kStudyCriteria) return;
  const auto refuse = [](const char* what, const char* instead) {
    throw BadInput(fmt::format("profile {} has no code for {}: take {}, or profile {}", Profile::kName, what,
                               instead, Workstation::kName));
  };
  if (has_conforming_front(model.remesh.rotation)) refuse("rotations siblings and full", "rotations misfit");
  if (looks_at_neighbours(model.remesh.stretch)) refuse("stretch strain-jump", "stretch six-edges");
}

/// Levels that follow from the level at start get their values, so that a summary names them, as it does
/// those of a contact.
void complete_levels(ModelParameters& model) {
  for (RegionParameters& region : model.regions) {
    region.least_level = model.least_level(region);
    region.most_level = model.most_level(region);
  }
}

template <class Profile>
Fit fit(Scenario& scenario) {
  const auto state = std::make_unique<State<Profile>>();
  require_levels_of_profile<Profile>(scenario.model);
  require_criteria_of_profile<Profile>(scenario.model);
  require_substeps_of_profile<Profile>(scenario.model);
  if (scenario.model.substeps == Scenario::kAutomaticSubsteps) {
    scenario.model.substeps = std::min<int>(kMostAutomaticSubsteps, Profile::kSubsteps);
  }
  int& level = scenario.model.level;
  if (level == Scenario::kAutomaticLevel) level = deepest_level(scenario, *state);
  const bool may_fit =
      level >= 0 && level <= Profile::kMaxLevel && tets_at(scenario.model, level) <= Profile::kLeaves;
  if (!may_fit || try_level(scenario, level, *state) != Status::kDone) refuse(scenario, *state);
  check_domain(scenario.model);  // with the levels that the mesh may go to
  complete_levels(scenario.model);
  scenario.model.contact = complete_contact(scenario.model);
  return Fit{state->forest.leaf_count, state->forest.nodes.used(), sizeof(State<Profile>),
             sizeof(firmware::CycleState<Profile>)};
}

}  // namespace

Fit fit_to_profile(Scenario& scenario) {
  return with_profile(scenario.profile, [&](auto profile) { return fit<decltype(profile)>(scenario); });
}

}  // namespace palpate::sim
