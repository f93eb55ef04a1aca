// How the tool touches, as an author writes it: SI units, doubles. What is left automatic follows from the
// model's mass and stiffness, so that any model can be touched by giving the tool a radius.
#pragma once

#include "palpate/touch/contact_rules.hpp"

namespace palpate::sim {

struct ModelParameters;

/// Of a value that follows from the model.
inline constexpr double kAutomatic = -1.0;

struct ContactParameters {
  double tool_radius_m = 0.0;           // 0: no contact
  double stiffness_n_m = kAutomatic;    // half of the largest stable one, at most 1000
  double damping_n_s_m = kAutomatic;    // stops in a tick what the stiffness pushes in a tick
  double friction = 0.2;                // Coulomb's mu
  double force_limit_n = kAutomatic;    // 8, or the model's limit
  double slew_n_per_tick = kAutomatic;  // what a tool of 2 m/s asks for, at most the force limit
  double passivity_ceiling_j = 0.1;     // what the observer keeps of the hand's work
  double passivity_damping_n_s_m =
      kAutomatic;  // most of the controller's, 5 or the model's limit; 0: observe

  [[nodiscard]] bool is_on() const { return tool_radius_m > 0.0; }
};

/// The contact's stability, by the motion of one node that is free: a quarter of the lightest tet that the
/// mesh may have, of mass m. Every other node that a tool can load is heavier. A tick is T, a substep T / n.
/// The coupling's force is set once a tick, from positions at its start, and stays for n substeps; with
///   kappa = k T^2 / m,  beta = b T / m,  c = (n + 1) / (2 n),  d = (n - 1) / (2 n)
/// a node at x with x - v T of the tick before obeys
///   z (z - 1)^2 + (kappa z + beta (z - 1)) (d + c z) = 0,
/// whose roots are within the unit circle where
///   kappa < beta (1 - d beta) / (d (1 + c beta))  for n > 1,   kappa + 2 beta < 4 n.
/// kappa is k w n^2 of docs/decisions/0012-contact.md: w, what a unit force moves this node in a substep, is
/// T^2 / (n^2 m). Without damping a node is taken up to kappa = 1/4, which the body's own damping holds down
/// (measured there). At n = 1 it is taken up to 2, half of the limit, at which nothing damps. At n = 1
/// elastic forces act in the same step, and of the 4 they take (dt^2 + 2 dt beta_K) w_max^2, w_max = 2 /
/// critical step.
struct ContactStability {
  double mass_kg;     // m
  double substeps;    // n
  double free_share;  // 1 less the elastic forces' part at n = 1
  [[nodiscard]] double largest_damping_n_s_m() const;
  [[nodiscard]] double largest_stiffness_n_m(double damping_n_s_m) const;
};
ContactStability contact_stability(const ModelParameters& parameters);

/// The model's contact with all automatic values.
ContactParameters complete_contact(const ModelParameters& parameters);

/// Of a model whose body is in the domain. Throws BadInput for a radius outside 1/64 .. 1/2 edge, a value
/// that the core's formats do not hold, or a coupling that is not stable; nothing when contact is off.
void check_contact(const ModelParameters& parameters);

/// All zero when contact is off.
ContactRules compile_contact(const ModelParameters& parameters);

}  // namespace palpate::sim
