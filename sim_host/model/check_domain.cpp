#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "domain.hpp"
#include "model_parameters.hpp"
#include "stability.hpp"

namespace palpate::sim {

void require_range(const std::string& name, double value, const Range& range) {
  if (range.contains(value)) return;
  throw BadInput(fmt::format("{} is {:g}, but must be {:g} to {:g}", name, value, range.low, range.high));
}

namespace {

void check_regions(const ModelParameters& parameters) {
  const auto& regions = parameters.regions;
  if (regions.empty() || regions.size() > kRegions) {
    throw BadInput(fmt::format("a model has {} regions, but must have 1 to {}", regions.size(), kRegions));
  }
  const double stiffest = reference_modulus_pa(parameters);
  double heaviest = 0.0;
  for (const auto& region : regions) heaviest = std::max(heaviest, region.density_kg_m3);
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const std::string where = place_of_region(parameters, i);
    require_range(where + "youngs_modulus_pa", regions[i].youngs_modulus_pa, domain::kYoungsModulusPa);
    require_range(where + "poisson_ratio", regions[i].poisson_ratio, domain::kPoissonRatio);
    require_range(where + "density_kg_m3", regions[i].density_kg_m3, domain::kDensityKgM3);
    require_range(where + "largest youngs_modulus_pa over this one", stiffest / regions[i].youngs_modulus_pa,
                  domain::kModulusRatio);
    require_range(where + "largest density_kg_m3 over this one", heaviest / regions[i].density_kg_m3,
                  domain::kDensityRatio);
  }
}

void check_shape(const ModelParameters& parameters) {
  constexpr const char* kAxes[3] = {"x", "y", "z"};
  std::size_t count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    require_range(fmt::format("cubes along {}", kAxes[axis]), parameters.cubes[axis], domain::kCubesPerAxis);
    count *= static_cast<std::size_t>(parameters.cubes[axis]);
  }
  require_range("edge_m", parameters.edge_m, domain::kEdgeM);
  require_range("level", parameters.level, domain::kLevel);
  const auto& map = parameters.region_of_cube;
  if (!map.empty() && map.size() != count) {
    throw BadInput(
        fmt::format("region_of_cube has {} entries, but the block has {} cubes", map.size(), count));
  }
  for (const int region : map) {
    require_range("an entry of region_of_cube", region,
                  {domain::kRegionOfCube.low, static_cast<double>(parameters.regions.size()) - 1.0});
  }
  if (!map.empty() && std::all_of(map.begin(), map.end(), [](int region) { return region < 0; })) {
    throw BadInput("region_of_cube leaves no cube: at least one entry must be 0 or more");
  }
}

/// Displacement a substep of the lightest possible node (one tet) for a unit force must fit the core's
/// Impulse.
void check_impulse(const ModelParameters& parameters) {
  constexpr double kHighest = 7.99;
  constexpr double kLowest = 1.0 / 65536.0;  // of the heaviest, 48 tets: 12 bits are left
  double lightest = 1e9;
  double heaviest = 0.0;
  int finest = 0;
  for (const RegionParameters& region : parameters.regions) {
    finest = std::max(finest, parameters.finest_level(region));
    lightest = std::min(lightest, region.density_kg_m3);
    heaviest = std::max(heaviest, region.density_kg_m3);
  }
  const double step_s = 1e-3 / parameters.substeps;
  const double tet_m3 = std::pow(parameters.edge_m, 3) / 6.0 * std::ldexp(1.0, -finest);
  const double force_step = step_s * step_s * reference_modulus_pa(parameters) * parameters.edge_m;
  const double highest = force_step / (lightest * tet_m3 / 4.0);
  if (highest > kHighest) {
    const int needed = static_cast<int>(std::ceil(parameters.substeps * std::sqrt(highest / kHighest)));
    throw BadInput(fmt::format(
        "a force moves the lightest node too far in one substep; the model needs {} substeps", needed));
  }
  if (force_step / (heaviest * tet_m3 * 12.0) < kLowest) {
    throw BadInput(
        "the body is too heavy for its stiffness: take a smaller edge_m or density_kg_m3, fewer substeps or "
        "a larger "
        "youngs_modulus_pa");
  }
}

void check_step(const ModelParameters& parameters) {
  require_range("substeps", parameters.substeps, domain::kSubsteps);
  require_range("mass_damping_per_s", parameters.mass_damping_per_s, domain::kMassDampingPerS);
  const double step_s = 1e-3 / parameters.substeps;
  const int needed = needed_substeps(parameters);
  if (parameters.substeps < needed) {
    const int finest = parameters.finest_level(least_stable_region(parameters));
    const char* level = finest == parameters.level ? "level" : "most_level";
    const auto advice = needed <= static_cast<int>(kMaxSubsteps)
                            ? fmt::format("needs {} substeps", needed)
                            : fmt::format(
                                  "would need {} substeps, more than {}: take a coarser {}, a larger density "
                                  "or a softer material",
                                  needed, kMaxSubsteps, level);
    throw BadInput(fmt::format(
        "the model is unstable with {} substeps of {:.3f} ms: its critical step at {} {} is "
        "{:.3f} ms; it {}",
        parameters.substeps, step_s * 1e3, level, finest, critical_step_s(parameters) * 1e3, advice));
  }
  check_impulse(parameters);
  const double largest = largest_stiffness_damping_s(critical_step_s(parameters), step_s);
  require_range("stiffness_damping_s", parameters.stiffness_damping_s,
                {0.0, std::min(largest, domain::kLargestDampingInSteps * step_s)});
}

/// The mesh starts at one level everywhere, so each region's range must hold it.
void check_levels(const ModelParameters& parameters, std::size_t i) {
  const RegionParameters& region = parameters.regions[i];
  const int least = parameters.least_level(region);
  const int most = parameters.most_level(region);
  const std::string where = place_of_region(parameters, i);
  require_range(where + "least_level", least, domain::kLevel);
  require_range(where + "most_level", most, domain::kLevel);
  const auto refuse = [&](const char* name, int value, const char* bound_name, int bound, const char* side) {
    throw BadInput(fmt::format("{}{} is {}, but {} is {}: it must be {} or {}", where, name, value,
                               bound_name, bound, bound, side));
  };
  const bool both_are_given = region.least_level != kStartLevel && region.most_level != kStartLevel;
  if (both_are_given && least > most) refuse("most_level", most, "least_level", least, "more");
  if (parameters.level < least) refuse("level", parameters.level, "least_level", least, "more");
  if (parameters.level > most) refuse("level", parameters.level, "most_level", most, "less");
}

void check_remesh(const ModelParameters& parameters) {
  const RemeshParameters& remesh = parameters.remesh;
  require_range("rotation_level", remesh.rotation_level, domain::kLevel);
  require_range("rotation_split_deg", remesh.rotation_split_deg, domain::kRotationSplitDeg);
  require_range("rotation_join_ratio", remesh.rotation_join_ratio, domain::kHysteresis);
  require_range("stretch_split", remesh.stretch_split, domain::kStretchSplit);
  require_range("stretch_merge_ratio", remesh.stretch_merge_ratio, domain::kHysteresis);
  for (std::size_t i = 0; i < parameters.regions.size(); ++i) check_levels(parameters, i);
}

}  // namespace

std::string place_of_region(const ModelParameters& parameters, std::size_t i) {
  return parameters.regions.size() == 1 ? "" : fmt::format("region {}: ", i);
}

void check_domain(const ModelParameters& parameters) {
  check_shape(parameters);
  check_regions(parameters);
  check_remesh(parameters);
  check_step(parameters);
  require_range("grasp_reach_m", parameters.grasp_reach_m, {0.0, domain::kReachEdges * parameters.edge_m});
  check_contact(parameters);
}

}  // namespace palpate::sim
