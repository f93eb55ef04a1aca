#include <algorithm>
#include <cmath>

#include "contact_parameters.hpp"
#include "model_parameters.hpp"
#include "stability.hpp"
#include "units.hpp"

namespace palpate::sim {
namespace {

constexpr double kUndamped = 0.25;  // kappa that a body's own damping holds down
constexpr double kLargest = 2.0;    // half of what is neither damped nor driven at one substep

/// c and d above.
double late_share(double n) { return (n + 1.0) / (2.0 * n); }
double early_share(double n) { return (n - 1.0) / (2.0 * n); }

double lightest_node_kg(const ModelParameters& parameters) {
  const double root_m3 = std::pow(parameters.edge_m, 3) / 6.0;
  double lightest = HUGE_VAL;
  for (const RegionParameters& region : parameters.regions) {
    const double tet_m3 = std::ldexp(root_m3, -parameters.finest_level(region));
    lightest = std::min(lightest, region.density_kg_m3 * tet_m3 / 4.0);
  }
  return lightest;
}

/// What elastic forces leave of the explicit step's limit, where they act once a tick as the contact does.
double free_share(const ModelParameters& parameters) {
  if (parameters.substeps > 1) return 1.0;
  const double critical_s = critical_step_s(parameters);
  const double elastic = kTickS * (kTickS + 2.0 * parameters.stiffness_damping_s) / (critical_s * critical_s);
  return std::max(0.0, 1.0 - elastic);
}

}  // namespace

ContactStability contact_stability(const ModelParameters& parameters) {
  return {lightest_node_kg(parameters), static_cast<double>(parameters.substeps), free_share(parameters)};
}

/// Half of the parabola's width in beta, and of the other limit: room for kappa is left.
double ContactStability::largest_damping_n_s_m() const {
  double beta = substeps * free_share;
  if (substeps > 1.0) beta = std::min(beta, 0.5 / early_share(substeps));
  return beta * mass_kg / kTickS;
}

double ContactStability::largest_stiffness_n_m(double damping_n_s_m) const {
  const double beta = damping_n_s_m * kTickS / mass_kg;
  double kappa = std::min(kLargest * free_share, 4.0 * substeps * free_share - 2.0 * beta);
  if (substeps > 1.0) {
    const double d = early_share(substeps);
    const double damped = beta * (1.0 - d * beta) / (d * (1.0 + late_share(substeps) * beta));
    kappa = std::min(kappa, std::max(kUndamped, damped));
  }
  return std::max(0.0, kappa) * mass_kg / (kTickS * kTickS);
}

}  // namespace palpate::sim
