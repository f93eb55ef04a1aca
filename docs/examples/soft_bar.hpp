// The body of both examples: a bar of three cubes, written by hand in the core's own units, which are the
// edge of a cube, the substep, and E_ref edge^2 for forces. Only integers: ratio(a, b) is the format's
// nearest number to a / b.
#pragma once

#include "palpate/elastic/groups.hpp"
#include "palpate/tick/model.hpp"
#include "palpate/tick/profiles.hpp"

namespace example {

using palpate::Position;
using palpate::Q;

// In SI: edge 64 mm, E = 500 Pa, nu = 0.49, 1000 kg/m3, one substep a tick of 1 ms.
inline constexpr int64_t kEdgeMm = 64;
inline constexpr int64_t kTickUs = 1000;

/// One unit of force is E edge^2 = 500 Pa (0.064 m)^2 = 2.048 N.
inline constexpr int64_t kForceUnitMicronewtons = 2048000;

inline palpate::Material soft_material() {
  // mu / (6 E) with mu = E / (2 (1 + nu)), and lambda / (6 E) with lambda = E nu / ((1 + nu) (1 - 2 nu)).
  return {palpate::ShearCoefficient::ratio(100, 12 * 149),
          palpate::BulkCoefficient::ratio(49 * 100, 6 * 149 * 2)};
}

inline palpate::Dynamics heavy_dynamics() {
  palpate::Dynamics dynamics{};
  dynamics.substeps = 1;
  dynamics.mass_damping = Q<-5, 36>::ratio(20 * kTickUs, 1000000);  // 20 / s
  dynamics.stiffness_damping = Q<0, 31>::ratio(50, kTickUs);        // 50 us
  // A force unit moves a unit of mass by dt^2 E edge / m edges a tick, where m = density edge^3 / (24 2^26)
  // kg: 1e-6 s^2 x 500 Pa x 24 x 2^26 / (1000 kg/m3 x (0.064 m)^2) = 3/4 x 2^18.
  dynamics.impulse_mantissa = Q<0, 31>::ratio(3, 4);
  dynamics.impulse_exponent = 18;
  return dynamics;
}

/// Rotations on as few tetrahedra as a misfit of 2 (1 - cos 1.5 deg) allows, joined again below 0.7 of that;
/// the mesh stays as it is.
inline palpate::RemeshRules remesh_rules() {
  constexpr auto kSplit = palpate::Misfit::ratio(6853, 10000000);
  constexpr auto kJoin = palpate::Misfit::ratio(4797, 10000000);
  palpate::RemeshRules rules{};
  rules.rotation = {palpate::RotationCriterion::kMisfit, 0, static_cast<uint32_t>(kSplit.raw()),
                    static_cast<uint32_t>(kJoin.raw())};
  rules.stretch.criterion = palpate::StretchCriterion::kFixed;
  return rules;
}

inline palpate::Model soft_bar() {
  palpate::Model model{};
  model.block = palpate::Block{{1, 1, 3}, {0, 0, 0}};  // cubes along x, y, z; all of material region 0
  model.level = 3;  // every root tetrahedron bisected three times: 144 leaves
  model.materials[0] = soft_material();
  model.region_density[0] = palpate::kDensityOne;
  model.dynamics = heavy_dynamics();
  model.remesh = remesh_rules();
  // The low end stands still: all nodes on the face z = 0 of the block's grid. Nothing else is held.
  model.held[0] = {model.block.corner(0, 0, 0), model.block.corner(1, 1, 0)};
  model.held[1] = {{1, 1, 1}, {0, 0, 0}};  // empty: min > max
  model.grasp_reach = Position::ratio(10, kEdgeMm);
  return model;
}

/// A length in the body's frame; its origin is the middle of the bar.
inline Position from_mm(int64_t mm) { return Position::ratio(mm, kEdgeMm); }

}  // namespace example
