// The device around a body: its frame, and the scales between hand and tool.
#include <algorithm>
#include <cmath>
#include <string>

#include "domain.hpp"
#include "model_parameters.hpp"
#include "units.hpp"

namespace palpate::sim {
namespace {

constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;
constexpr const char* kAxes[3] = {"x", "y", "z"};

bool is_turned_or_scaled(const SceneParameters& scene) {
  return scene.motion_scale != 1.0 || scene.device_rotation_deg != std::array<double, 3>{};
}

/// Minus the device's origin in the body's frame, in metres of the body.
std::array<double, 3> centre_in_body_axes(const SceneParameters& scene) {
  const std::array<double, 9> r = device_rotation(scene);
  const auto& c = scene.body_centre_in_device_m;
  std::array<double, 3> turned{};
  for (std::size_t i = 0; i < 3; ++i) {
    turned[i] = (r[3 * i] * c[0] + r[3 * i + 1] * c[1] + r[3 * i + 2] * c[2]) * scene.motion_scale;
  }
  return turned;
}

}  // namespace

std::array<double, 9> device_rotation(const SceneParameters& scene) {
  std::array<double, 3> c{};
  std::array<double, 3> s{};
  for (std::size_t i = 0; i < 3; ++i) {
    c[i] = std::cos(scene.device_rotation_deg[i] * kRadiansPerDegree);
    s[i] = std::sin(scene.device_rotation_deg[i] * kRadiansPerDegree);
  }
  // Rz Ry Rx
  return {c[2] * c[1],
          c[2] * s[1] * s[0] - s[2] * c[0],
          c[2] * s[1] * c[0] + s[2] * s[0],
          s[2] * c[1],
          s[2] * s[1] * s[0] + c[2] * c[0],
          s[2] * s[1] * c[0] - c[2] * s[0],
          0.0 - s[1],
          c[1] * s[0],
          c[1] * c[0]};
}

std::array<double, 3> in_device_m(const SceneParameters& scene, const std::array<double, 3>& from_centre_m) {
  const std::array<double, 9> r = device_rotation(scene);
  const auto& x = from_centre_m;
  std::array<double, 3> device = scene.body_centre_in_device_m;
  for (std::size_t i = 0; i < 3; ++i) {
    device[i] += (r[i] * x[0] + r[3 + i] * x[1] + r[6 + i] * x[2]) / scene.motion_scale;
  }
  return device;
}

void check_domain(const SceneParameters& scene, const ModelParameters& parameters) {
  require_range("force_scale", scene.force_scale, domain::kForceScale);
  require_range("motion_scale", scene.motion_scale,
                {domain::kMotionScale.low,
                 std::min(domain::kMotionScale.high, parameters.edge_m * domain::kMostEdgesPerM)});
  for (const double degrees : scene.device_rotation_deg) {
    require_range("device_rotation_deg", degrees, domain::kRotationDeg);
  }
  const double reach_m = domain::kReachEdges * parameters.edge_m;
  const std::array<double, 3> centre = centre_in_body_axes(scene);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::string name = "body_centre_in_device_m";
    if (is_turned_or_scaled(scene))
      name += std::string(", turned and scaled, along the body's ") + kAxes[axis];
    require_range(name, centre[axis], {-reach_m, reach_m});
  }
}

firmware::Scene compile_scene(const SceneParameters& scene, const ModelParameters& parameters) {
  check_domain(scene, parameters);
  firmware::Scene result{};
  result.edges_per_metre = to_fixed<firmware::EdgesPerMetre>(scene.motion_scale / parameters.edge_m);
  const std::array<double, 3> centre = centre_in_body_axes(scene);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.device_origin[axis] = to_fixed<Position>(-centre[axis] / parameters.edge_m);
  }
  const std::array<double, 9> rotation = device_rotation(scene);
  for (std::size_t i = 0; i < 9; ++i) result.device_rotation[i] = to_fixed<RotationEntry>(rotation[i]);
  int exponent = 0;
  const double mantissa = std::frexp(newtons_per_unit(parameters) * scene.force_scale, &exponent);
  result.newton_mantissa = to_fixed_below<Q<0, 31>>(mantissa);
  result.newton_exponent = static_cast<int8_t>(exponent);
  return result;
}

}  // namespace palpate::sim
