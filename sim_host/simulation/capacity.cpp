#include "simulation/capacity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "palpate/firmware/cycle.hpp"
#include "simulation/with_profile.hpp"

namespace palpate::sim {
namespace {

constexpr int kDeepestAutomaticLevel = 6;

int64_t tets_at(const ModelParameters& model, int level) {
  int64_t cubes = int64_t{model.cubes[0]} * model.cubes[1] * model.cubes[2];
  if (!model.region_of_cube.empty()) {
    cubes =
        std::count_if(model.region_of_cube.begin(), model.region_of_cube.end(), [](int r) { return r >= 0; });
  }
  return cubes * kRootsPerCube << level;
}

template <class Profile>
Status try_level(const Scenario& scenario, int level, State<Profile>& state) {
  ModelParameters at_level = scenario.model;
  at_level.level = level;
  return start(state, compile_model(at_level));
}

template <class Profile>
int deepest_level(const Scenario& scenario, State<Profile>& state) {
  for (int level = std::min<int>(kDeepestAutomaticLevel, Profile::kMaxLevel); level >= 0; --level) {
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
Fit fit(Scenario& scenario) {
  const auto state = std::make_unique<State<Profile>>();
  int& level = scenario.model.level;
  if (level == Scenario::kAutomaticLevel) level = deepest_level(scenario, *state);
  const bool may_fit =
      level >= 0 && level <= Profile::kMaxLevel && tets_at(scenario.model, level) <= Profile::kLeaves;
  if (!may_fit || try_level(scenario, level, *state) != Status::kDone) refuse(scenario, *state);
  return Fit{state->forest.leaf_count, state->forest.nodes.used(), sizeof(State<Profile>),
             sizeof(firmware::CycleState<Profile>)};
}

}  // namespace

Fit fit_to_profile(Scenario& scenario) {
  return with_profile(scenario.profile, [&](auto profile) { return fit<decltype(profile)>(scenario); });
}

}  // namespace palpate::sim
