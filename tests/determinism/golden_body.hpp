// The body of the scenarios whose hashes are golden, for the profile that PALPATE_PROFILE names.
//
// It is written down as integers and does not come from the model compiler, because golden hashes must not
// depend on a host's doubles: a last bit of another libm would look like a change of the simulation.
#pragma once

#include "palpate/firmware/scenario_image.hpp"
#include "palpate/remesh/stretch.hpp"
#include "palpate/tick/profiles.hpp"

namespace palpate::golden {

using Profile = palpate::PALPATE_PROFILE;

/// The bar of 1 x 1 x 3 cubes of 64 mm, E = 500 Pa, nu = 0.49, its low end held. The upper cube has half the
/// stiffness and half the density. Groups split at 1.5 degrees and are joined at 0.85 of that; leaves split
/// where an edge is 6 percent longer and are merged at half of that. What differs between scenarios and
/// profiles:
struct Discretization {
  uint8_t level;  // at start
  uint8_t least_level;
  uint8_t most_level;
  uint8_t substeps;
  uint16_t density_kg_m3;
  // dt^2 E edge / (kg a mass unit)
  Q<0, 31> impulse_mantissa;
  int8_t impulse_exponent;
};

/// Of the image that is linked.
extern const Discretization kDiscretization;

/// mu = E / (2 (1 + nu)) and lambda = E nu / ((1 + nu) (1 - 2 nu)) with nu = 0.49, for a region of E_ref /
/// softness.
constexpr Material make_material(int64_t softness) {
  constexpr int64_t kOnePlusNu = 149;
  constexpr int64_t kOneMinusTwoNu = 2;
  constexpr int64_t kNu = 49;
  return Material{ShearCoefficient::ratio(100, 12 * kOnePlusNu * softness),
                  BulkCoefficient::ratio(kNu * 100, 6 * kOnePlusNu * kOneMinusTwoNu * softness)};
}

constexpr Dynamics make_dynamics(const Discretization& mesh) {
  const int64_t substeps = mesh.substeps;
  Dynamics dynamics{};
  dynamics.substeps = mesh.substeps;
  dynamics.mass_damping = Q<-5, 36>::ratio(2, 1000 * substeps);       // 2 / s
  dynamics.stiffness_damping = Q<0, 31>::ratio(50 * substeps, 1000);  // 50 us
  dynamics.impulse_mantissa = mesh.impulse_mantissa;
  dynamics.impulse_exponent = mesh.impulse_exponent;
  return dynamics;
}

/// With both fronts on the move.
constexpr RemeshRules make_rules(const Discretization& mesh) {
  RemeshRules rules{};
  rules.rotation.criterion = RotationCriterion::kMisfit;
  rules.rotation.start_level = 0;
  rules.rotation.split_above = 2943556;  // 2 (1 - cos 1.5 deg) 2^32
  rules.rotation.join_below = 2126753;   // 2 (1 - cos 1.275 deg) 2^32
  rules.stretch.criterion = StretchCriterion::kSixEdges;
  rules.stretch.split_above = StretchMeasure::ratio(1236, 10000);  // 1.06^2 - 1
  rules.stretch.merge_below = StretchMeasure::ratio(609, 10000);   // 1.03^2 - 1
  for (LevelRange& levels : rules.stretch.levels) levels = LevelRange{mesh.least_level, mesh.most_level};
  return rules;
}

constexpr Model make_body(const Discretization& mesh) {
  Model body{};
  body.block = Block{{1, 1, 3}, {0, 0, 1}};
  body.level = mesh.level;
  for (uint32_t i = 0; i < kRegions; ++i) {
    body.materials[i] = make_material(i == 1 ? 2 : 1);
    body.region_density[i] = i == 1 ? kDensityOne / 2 : kDensityOne;
  }
  body.dynamics = make_dynamics(mesh);
  body.remesh = make_rules(mesh);
  body.held[0] = LatticeBox{body.block.corner(0, 0, 0), body.block.corner(1, 1, 0)};
  body.held[1] = LatticeBox{{1, 1, 1}, {0, 0, 0}};
  body.grasp_reach = Position::ratio(1, 2);
  return body;
}

/// At zero counts the tool, at (0.215, 0, -0.170) m, is beside the node at (0.5, 0, 1) edges.
constexpr firmware::Scene make_scene() {
  firmware::Scene scene{};
  scene.edges_per_metre = firmware::EdgesPerMetre::ratio(1000, 64);
  scene.device_origin = {Position::ratio(-1820, 640), Position::ratio(0, 1), Position::ratio(2350, 640)};
  scene.device_rotation = firmware::kNotTurned;
  scene.newton_mantissa = Q<0, 31>::ratio(512, 1000);  // E edge^2 = 2.048 N = 0.512 2^2 N
  scene.newton_exponent = 2;
  return scene;
}

}  // namespace palpate::golden
