#include "stability.hpp"

#include <algorithm>
#include <cmath>

#include "units.hpp"

namespace palpate::sim {
namespace {

constexpr double kMargin = 0.9;

/// P-wave modulus over Young's modulus: what a stiff element's frequency grows with. Below nu = 0.3 the
/// fastest mode is one of shear, and the critical step no longer grows.
double p_wave_modulus_ratio(double poisson_ratio) {
  const double nu = std::max(poisson_ratio, 0.3);
  return (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
}

}  // namespace

double critical_step_s(int level, double edge_m, const RegionParameters& region) {
  constexpr double kTableS[9] = {1.226e-3, 1.126e-3, 0.853e-3, 0.781e-3, 0.664e-3,
                                 0.435e-3, 0.400e-3, 0.332e-3, 0.2175e-3};  // levels 0 to 8
  const double in_table =
      level < 9 ? kTableS[level] : kTableS[6 + level % 3] * std::ldexp(1.0, 2 - level / 3);
  const double by_edge = edge_m / 0.064;
  const double by_density = std::sqrt(region.density_kg_m3 / 10.0 * 500.0 / region.youngs_modulus_pa);
  const double by_poisson =
      std::sqrt(p_wave_modulus_ratio(0.49) / p_wave_modulus_ratio(region.poisson_ratio));
  return in_table * by_edge * by_density * by_poisson;
}

const RegionParameters& least_stable_region(const ModelParameters& parameters) {
  const auto step_s = [&](const RegionParameters& region) {
    return critical_step_s(parameters.finest_level(region), parameters.edge_m, region);
  };
  return *std::min_element(
      parameters.regions.begin(), parameters.regions.end(),
      [&](const RegionParameters& a, const RegionParameters& b) { return step_s(a) < step_s(b); });
}

double critical_step_s(const ModelParameters& parameters) {
  const RegionParameters& region = least_stable_region(parameters);
  return critical_step_s(parameters.finest_level(region), parameters.edge_m, region);
}

int needed_substeps(const ModelParameters& parameters) {
  return static_cast<int>(std::ceil(kTickS / (kMargin * critical_step_s(parameters))));
}

double largest_stiffness_damping_s(double critical_s, double substep_s) {
  return (critical_s * critical_s - substep_s * substep_s) / (2.0 * substep_s);
}

}  // namespace palpate::sim
