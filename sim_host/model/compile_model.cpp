#include <algorithm>
#include <cmath>

#include "model_parameters.hpp"
#include "palpate/elastic/groups.hpp"
#include "units.hpp"

namespace palpate::sim {
namespace {

constexpr double kPi = 3.14159265358979323846;

Block compile_block(const ModelParameters& parameters) {
  Block block{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    block.cubes[axis] = static_cast<uint8_t>(parameters.cubes[axis]);
  for (uint32_t i = 0; i < kMaxCubes; ++i) block.region[i] = Block::kAbsent;
  for (uint32_t i = 0; i < block.cube_count(); ++i) {
    const int region = parameters.region_of_cube.empty() ? 0 : parameters.region_of_cube[i];
    block.region[i] = region < 0 ? Block::kAbsent : static_cast<uint8_t>(region);
  }
  return block;
}

Material compile_material(const RegionParameters& region, double reference_pa) {
  const double nu = region.poisson_ratio;
  const double mu = region.youngs_modulus_pa / (2.0 * (1.0 + nu));
  const double lambda = region.youngs_modulus_pa * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
  return Material{to_fixed<ShearCoefficient>(mu / (6.0 * reference_pa)),
                  to_fixed<BulkCoefficient>(lambda / (6.0 * reference_pa))};
}

double heaviest_density(const ModelParameters& parameters) {
  double heaviest = 0.0;
  for (const auto& region : parameters.regions) heaviest = std::max(heaviest, region.density_kg_m3);
  return heaviest;
}

Dynamics compile_dynamics(const ModelParameters& parameters) {
  const double dt = kTickS / parameters.substeps;
  const double volume_of_root = std::pow(parameters.edge_m, 3) / 6.0;
  const double kg_per_mass_unit =
      heaviest_density(parameters) * volume_of_root / 4.0 / std::ldexp(kDensityOne, kMassLevels);
  const double impulse = dt * dt * reference_modulus_pa(parameters) * parameters.edge_m / kg_per_mass_unit;
  int exponent = 0;
  const double mantissa = std::frexp(impulse, &exponent);
  Dynamics dynamics{};
  dynamics.substeps = static_cast<uint8_t>(parameters.substeps);
  dynamics.mass_damping = to_fixed<Q<-5, 36>>(parameters.mass_damping_per_s * dt);
  dynamics.stiffness_damping = to_fixed<Q<0, 31>>(parameters.stiffness_damping_s / dt);
  dynamics.impulse_mantissa = to_fixed_below<Q<0, 31>>(mantissa);
  dynamics.impulse_exponent = static_cast<int8_t>(exponent);
  return dynamics;
}

const RegionParameters& region_or_last(const ModelParameters& parameters, std::size_t i) {
  return parameters.regions[std::min(i, parameters.regions.size() - 1)];
}

/// 4 (1 - cos) is |R_m - R_n|_F^2; a root whose halves are this far apart has half of it as misfit.
uint32_t compile_angle(double degrees, RotationCriterion criterion) {
  const double square = 4.0 * (1.0 - std::cos(degrees * kPi / 180.0));
  return static_cast<uint32_t>(criterion == RotationCriterion::kSiblings
                                   ? to_fixed<Q<4, 27>>(square).raw()
                                   : to_fixed_below<Misfit>(square / 2.0).raw());
}

RotationRules compile_rotation_rules(const RemeshParameters& remesh) {
  // Full corotation splits what measures 1 and joins what measures 0: see remesh_stage.hpp.
  if (remesh.rotation == RotationCriterion::kFull) return RotationRules{remesh.rotation, 0, 0, 1};
  return RotationRules{
      remesh.rotation, static_cast<uint8_t>(remesh.rotation_level),
      compile_angle(remesh.rotation_split_deg, remesh.rotation),
      compile_angle(remesh.rotation_join_ratio * remesh.rotation_split_deg, remesh.rotation)};
}

/// A mesh that may not change costs nothing.
StretchRules compile_stretch_rules(const ModelParameters& parameters) {
  const RemeshParameters& remesh = parameters.remesh;
  const auto threshold = [&](double value) {
    const bool is_jump = remesh.stretch == StretchCriterion::kStrainJump;
    return to_fixed<Q<4, 27>>(is_jump ? 2.0 * value : (1.0 + value) * (1.0 + value) - 1.0);
  };
  StretchRules rules{parameters.mesh_may_change() ? remesh.stretch : StretchCriterion::kFixed,
                     threshold(remesh.stretch_split),
                     threshold(remesh.stretch_merge_ratio * remesh.stretch_split),
                     {}};
  for (std::size_t i = 0; i < kRegions; ++i) {
    const RegionParameters& region = region_or_last(parameters, i);
    rules.levels[i] = {static_cast<uint8_t>(parameters.least_level(region)),
                       static_cast<uint8_t>(parameters.most_level(region))};
  }
  return rules;
}

/// The box of lattice points on the low (0) or high (1) end face of the longest axis.
LatticeBox end_face(const Block& block, int end) {
  const uint8_t* cubes = block.cubes;
  const auto longest = static_cast<std::size_t>(std::max_element(cubes, cubes + 3) - cubes);
  std::array<uint32_t, 3> low = {0, 0, 0};
  std::array<uint32_t, 3> high = {cubes[0], cubes[1], cubes[2]};
  (end == 0 ? high : low)[longest] = end == 0 ? 0 : cubes[longest];
  return LatticeBox{block.corner(low[0], low[1], low[2]), block.corner(high[0], high[1], high[2])};
}

}  // namespace

double reference_modulus_pa(const ModelParameters& parameters) {
  double stiffest = 0.0;
  for (const auto& region : parameters.regions) stiffest = std::max(stiffest, region.youngs_modulus_pa);
  return stiffest;
}

double newtons_per_unit(const ModelParameters& parameters) {
  return reference_modulus_pa(parameters) * parameters.edge_m * parameters.edge_m;
}

Model compile_model(const ModelParameters& parameters) {
  check_domain(parameters);
  constexpr LatticeBox kEmpty{{1, 1, 1}, {0, 0, 0}};
  Model model{};
  model.block = compile_block(parameters);
  model.level = static_cast<uint8_t>(parameters.level);
  for (std::size_t i = 0; i < kRegions; ++i) {
    const RegionParameters& region = region_or_last(parameters, i);
    model.materials[i] = compile_material(region, reference_modulus_pa(parameters));
    model.region_density[i] = static_cast<uint16_t>(
        std::lround(region.density_kg_m3 / heaviest_density(parameters) * static_cast<double>(kDensityOne)));
  }
  model.dynamics = compile_dynamics(parameters);
  model.remesh = {compile_rotation_rules(parameters.remesh), compile_stretch_rules(parameters)};
  model.held = {parameters.held == HeldEnds::kNone ? kEmpty : end_face(model.block, 0),
                parameters.held == HeldEnds::kBoth ? end_face(model.block, 1) : kEmpty};
  model.grasp_reach = to_fixed<Position>(parameters.grasp_reach_m / parameters.edge_m);
  model.contact = compile_contact(parameters);
  return model;
}

std::array<double, 3> to_mm(const Vector3<Position>& x, const ModelParameters& parameters) {
  std::array<double, 3> mm{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double from_corner = to_double(x[static_cast<Eigen::Index>(axis)]) + parameters.cubes[axis] / 2.0;
    mm[axis] = from_corner * parameters.edge_m * 1e3;
  }
  return mm;
}

Vector3<Position> from_mm(const std::array<double, 3>& mm, const ModelParameters& parameters) {
  Vector3<Position> x;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double edges = mm[axis] * 1e-3 / parameters.edge_m - parameters.cubes[axis] / 2.0;
    x[static_cast<Eigen::Index>(axis)] = to_fixed<Position>(std::clamp(edges, -15.9, 15.9));
  }
  return x;
}

}  // namespace palpate::sim
