// A model as its author writes it: SI units, doubles. compile_model turns it into the core's integers, or
// refuses it with the place, the value and the range that would be right.
#pragma once

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "contact_parameters.hpp"
#include "palpate/firmware/scenario_image.hpp"

namespace palpate::sim {

/// Bad input: exit code 2. The message is one line: what, where, what would be right.
struct BadInput : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Of a region's levels that are not given: leaves stay as fine as they start.
inline constexpr int kStartLevel = -1;

struct RegionParameters {
  double youngs_modulus_pa = 500.0;
  double poisson_ratio = 0.49;
  double density_kg_m3 = 10.0;
  int least_level = kStartLevel;  // of leaves, while the mesh changes
  int most_level = kStartLevel;
};

enum class HeldEnds { kNone, kOne, kBoth };  // the faces at the low end, or at both ends, of the longest axis

/// When the two fronts change (palpate/remesh/rules.hpp).
struct RemeshParameters {
  RotationCriterion rotation = RotationCriterion::kMisfit;
  int rotation_level = 0;             // of the coarsest rotation tets
  double rotation_split_deg = 1.5;    // theta_max
  double rotation_join_ratio = 0.85;  // theta_min / theta_max
  StretchCriterion stretch = StretchCriterion::kSixEdges;
  double stretch_split = 0.1;        // elongation l / l0 - 1; of a strain jump, the difference of strains
  double stretch_merge_ratio = 0.5;  // the same below which leaves are merged, over stretch_split
};

struct ModelParameters {
  std::array<int, 3> cubes = {1, 1, 3};  // x, y, z
  double edge_m = 0.064;                 // of a cube
  int level = 6;
  std::vector<RegionParameters> regions = std::vector<RegionParameters>(1);
  std::vector<int> region_of_cube;  // x fastest; -1: absent; empty: all 0
  int substeps = 4;
  double mass_damping_per_s = 2.0;
  double stiffness_damping_s = 50e-6;
  HeldEnds held = HeldEnds::kOne;
  double grasp_reach_m = 0.010;
  RemeshParameters remesh;
  ContactParameters contact;

  [[nodiscard]] int least_level(const RegionParameters& region) const {
    return region.least_level == kStartLevel ? level : region.least_level;
  }
  [[nodiscard]] int most_level(const RegionParameters& region) const {
    return region.most_level == kStartLevel ? level : region.most_level;
  }
  /// Whether a leaf may ever be split or merged.
  [[nodiscard]] bool mesh_may_change() const {
    return remesh.stretch != StretchCriterion::kFixed &&
           std::any_of(regions.begin(), regions.end(), [this](const RegionParameters& region) {
             return least_level(region) != most_level(region);
           });
  }
  /// Of any leaf of a region, now or later.
  [[nodiscard]] int finest_level(const RegionParameters& region) const {
    return remesh.stretch == StretchCriterion::kFixed ? level : most_level(region);
  }
};

/// Where the device's workspace meets the body. A point x of the device's frame is the body's
/// R (x - body_centre_in_device_m) motion_scale, from the body's centre.
struct SceneParameters {
  std::array<double, 3> body_centre_in_device_m = {0.18, 0.0, -0.17};
  // How the device stands in the body's frame: turned about the body's x, then its y, then its z axis,
  // R = Rz Ry Rx (roll, pitch, yaw about fixed axes)
  std::array<double, 3> device_rotation_deg = {0.0, 0.0, 0.0};
  double motion_scale = 1.0;  // way of the tool over way of the handle
  double force_scale = 1.0;   // force on the handle over force of the tissue

  /// The hand's work over the tool's.
  [[nodiscard]] double work_scale() const { return force_scale / motion_scale; }
};

/// R by rows: columns are the device's axes in the body's frame.
std::array<double, 9> device_rotation(const SceneParameters& scene);
/// Where the handle is when the tool is here, in metres from the body's centre along its axes.
std::array<double, 3> in_device_m(const SceneParameters& scene, const std::array<double, 3>& from_centre_m);

/// Begins a message on one of several regions: "region 1: ", or nothing when there is one.
std::string place_of_region(const ModelParameters& parameters, std::size_t i);

/// The supported domain (docs/numerics.md) and a stable step. Throws BadInput outside.
void check_domain(const ModelParameters& parameters);
void check_domain(const SceneParameters& scene, const ModelParameters& parameters);

Model compile_model(const ModelParameters& parameters);
firmware::Scene compile_scene(const SceneParameters& scene, const ModelParameters& parameters);

/// Newtons for one unit of Force, and of E_ref: the largest Young's modulus of all regions.
double reference_modulus_pa(const ModelParameters& parameters);
double newtons_per_unit(const ModelParameters& parameters);
/// Millimetres in the body's file frame (origin at the block's low corner) of a position in the core's frame.
std::array<double, 3> to_mm(const Vector3<Position>& x, const ModelParameters& parameters);
Vector3<Position> from_mm(const std::array<double, 3>& mm, const ModelParameters& parameters);

}  // namespace palpate::sim
