#include "contact_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "domain.hpp"
#include "model_parameters.hpp"
#include "units.hpp"

namespace palpate::sim {
namespace {

constexpr double kStiffestNM = 1000.0;  // that is chosen unasked: below what a PHANToM renders
constexpr double kStrongestN = 8.0;     // a Premium 1.5 gives 8.5
constexpr double kFastestM = 0.002;     // in a tick
constexpr double kBrakeNSM = 5.0;       // of an arm of 75 g: 0.07 of its momentum a tick
/// Ends of Coupling, with at least 64 LSB.
constexpr Range kCoupling{0x1p-15, 0x1p10 - 0x1p-20};

/// N/m for one unit of Coupling.
double coupling_unit_n_m(const ModelParameters& parameters) {
  return newtons_per_unit(parameters) / parameters.edge_m;
}

void fill(double& value, double automatic) {
  if (value == kAutomatic) value = automatic;
}

Range scaled(const Range& range, double unit) { return {range.low * unit, range.high * unit}; }

void check_coupling(const ModelParameters& parameters, const ContactParameters& contact) {
  const ContactStability stability = contact_stability(parameters);
  const Range format = scaled(kCoupling, coupling_unit_n_m(parameters));
  const double most_damping = std::min(stability.largest_damping_n_s_m(), format.high * kTickS);
  const double stiffest = std::min(stability.largest_stiffness_n_m(contact.damping_n_s_m), format.high);
  if (stiffest < format.low) {
    throw BadInput(
        "a contact would be unstable at any contact_stiffness_n_m: take more substeps, a smaller "
        "stiffness_damping_s or a coarser mesh");
  }
  // A value that a message has told, with its digits, is taken.
  constexpr double kTold = 1.0 + 1e-5;
  if (!Range{0.0, most_damping * kTold}.contains(contact.damping_n_s_m)) {
    throw BadInput(
        fmt::format("the contact is unstable: contact_damping_n_s_m is {:g}, but must be 0 to {:g} for this "
                    "mesh and density",
                    contact.damping_n_s_m, most_damping));
  }
  if (!Range{format.low, stiffest * kTold}.contains(contact.stiffness_n_m)) {
    throw BadInput(
        fmt::format("the contact is unstable: contact_stiffness_n_m is {:g}, but must be {:g} to {:g} for "
                    "this mesh and density, with contact_damping_n_s_m {:g}; a coarser mesh or a larger "
                    "density allows more",
                    contact.stiffness_n_m, format.low, stiffest, contact.damping_n_s_m));
  }
}

}  // namespace

ContactParameters complete_contact(const ModelParameters& parameters) {
  ContactParameters contact = parameters.contact;
  const ContactStability stability = contact_stability(parameters);
  const double most_damping = stability.largest_damping_n_s_m();
  const double format_end = kCoupling.high * coupling_unit_n_m(parameters);
  const double given_damping = contact.damping_n_s_m == kAutomatic ? most_damping : contact.damping_n_s_m;
  const double stiffest = std::min(stability.largest_stiffness_n_m(given_damping), format_end);
  fill(contact.stiffness_n_m, std::min(stiffest / 2.0, kStiffestNM));
  fill(contact.damping_n_s_m, std::min({contact.stiffness_n_m * kTickS, most_damping, format_end * kTickS}));
  fill(contact.force_limit_n,
       std::min(kStrongestN, newtons_per_unit(parameters) * to_double(kContactForceLimit)));
  const double at_speed = (contact.stiffness_n_m + contact.damping_n_s_m / kTickS) * kFastestM;
  fill(contact.slew_n_per_tick, std::clamp(at_speed, domain::kContactForceN.low, contact.force_limit_n));
  fill(contact.passivity_damping_n_s_m, std::min(kBrakeNSM, format_end * kTickS));
  return contact;
}

void check_contact(const ModelParameters& parameters) {
  const ContactParameters contact = complete_contact(parameters);
  const Range radius = scaled(domain::kToolRadiusEdges, parameters.edge_m);
  if (contact.tool_radius_m == 0.0) return;
  if (!radius.contains(contact.tool_radius_m)) {
    throw BadInput(fmt::format("tool_radius_m is {:g}, but must be 0, or {:g} to {:g} with this edge_m",
                               contact.tool_radius_m, radius.low, radius.high));
  }
  check_coupling(parameters, contact);
  const double unit_n = newtons_per_unit(parameters);
  require_range("contact_friction", contact.friction, domain::kContactFriction);
  require_range("contact_force_limit_n", contact.force_limit_n,
                {domain::kContactForceN.low,
                 std::min(domain::kContactForceN.high, unit_n * to_double(kContactForceLimit))});
  require_range("contact_slew_n_per_tick", contact.slew_n_per_tick, domain::kContactForceN);
  require_range("passivity_ceiling_j", contact.passivity_ceiling_j, domain::kPassivityCeilingJ);
  require_range("passivity_damping_n_s_m", contact.passivity_damping_n_s_m,
                {domain::kDampingNSM.low, std::min(domain::kDampingNSM.high,
                                                   kCoupling.high * coupling_unit_n_m(parameters) * kTickS)});
}

ContactRules compile_contact(const ModelParameters& parameters) {
  ContactRules rules{};
  if (!parameters.contact.is_on()) return rules;
  const ContactParameters contact = complete_contact(parameters);
  const double unit_n = newtons_per_unit(parameters);
  const double unit_n_m = coupling_unit_n_m(parameters);
  constexpr double kCeilingSteps = 0x1p20;  // in E_ref edge^3
  rules.radius = to_fixed<Position>(contact.tool_radius_m / parameters.edge_m);
  rules.stiffness = to_fixed<Coupling>(contact.stiffness_n_m / unit_n_m);
  rules.damping = to_fixed<Coupling>(contact.damping_n_s_m / kTickS / unit_n_m);
  rules.friction = to_fixed<Fraction>(contact.friction);
  rules.force_limit = to_fixed<Force>(contact.force_limit_n / unit_n);
  // A force of the limit's length that turns around changes by twice the limit: more is never asked for.
  rules.slew = to_fixed<Force>(std::min(contact.slew_n_per_tick / unit_n, to_double(kMostContactSlew)));
  rules.passivity.ceiling = static_cast<uint32_t>(
      std::llround(contact.passivity_ceiling_j / (unit_n * parameters.edge_m) * kCeilingSteps));
  rules.passivity.most_damping = to_fixed<Coupling>(contact.passivity_damping_n_s_m / kTickS / unit_n_m);
  return rules;
}

}  // namespace palpate::sim
