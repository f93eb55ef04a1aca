// Largest stable step of explicit integration with lumped masses, from a table of measured critical steps.
#pragma once

#include "model_parameters.hpp"

namespace palpate::sim {

/// Critical step in seconds of a uniform mesh at this level. The table holds levels 0 to 8 of the 64 mm cube
/// at E = 500 Pa, rho = 10 kg/m3, nu = 0.49; then three levels halve it, and it scales with the edge,
/// sqrt(rho / E) and sqrt(E / (lambda + 2 mu)), with nu = 0.3 for all below. Within 8 % of power iteration
/// for nu 0 to 0.495, at levels 0 and 1 up to 24 % below; tests/oracle holds it to that.
double critical_step_s(int level, double edge_m, const RegionParameters& region);

/// The smallest over all regions, at the finest level of each.
double critical_step_s(const ModelParameters& parameters);

/// The region that has it.
const RegionParameters& least_stable_region(const ModelParameters& parameters);

/// Substeps of 1 ms that keep a step below 0.9 of the critical one.
int needed_substeps(const ModelParameters& parameters);

/// Largest beta_K in seconds that forces at x + beta_K v allow at this step: (4 / w^2 - dt^2) / (2 dt), w = 2
/// / critical.
double largest_stiffness_damping_s(double critical_s, double substep_s);

}  // namespace palpate::sim
