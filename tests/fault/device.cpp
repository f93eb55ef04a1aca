#include "device.hpp"

#include "plant/premium.hpp"

namespace palpate::fault {
namespace {

constexpr double kToolRadiusM = 0.005;
constexpr std::array<double, 3> kBodyCentreM = {0.2, 0.07, -0.234};
/// Of the surface, at a node of the coarse mesh.
constexpr std::array<double, 3> kTouchedMm = {32.0, 0.0, 160.0};
constexpr double kClearM = -0.003;

}  // namespace

sim::ModelParameters body_parameters() {
  sim::ModelParameters parameters;
  parameters.level = 3;
  parameters.substeps = 1;
  parameters.regions[0] = sim::RegionParameters{20e3, 0.49, 1200.0, 3, 4};
  parameters.grasp_reach_m = 0.02;
  parameters.contact.tool_radius_m = kToolRadiusM;
  parameters.contact.slew_n_per_tick = 0.02;
  return parameters;
}

firmware::CycleModel body_model() {
  sim::SceneParameters scene;
  scene.body_centre_in_device_m = kBodyCentreM;
  return {sim::compile_model(body_parameters()), sim::compile_scene(scene, body_parameters())};
}

safety::Parameters device_parameters() {
  safety::Parameters parameters;
  parameters.ramp.step_per_tick = safety::ramp_step(kRampTicks);
  parameters.motion.stuck_ticks = kStuckTicks;
  return parameters;
}

Eigen::Vector3d home() { return plant::premium::tool_position(Eigen::Vector3d::Zero()); }

Eigen::Vector3d point_at_surface(double inside_m) {
  const sim::ModelParameters body = body_parameters();
  Eigen::Vector3d point(kBodyCentreM.data());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    point[static_cast<Eigen::Index>(axis)] += kTouchedMm[axis] * 1e-3 - body.cubes[axis] * body.edge_m / 2.0;
  }
  point.y() += inside_m - kToolRadiusM;
  return point;
}

plant::Hand hand_with(std::vector<plant::Knot> knots) {
  plant::HandParameters parameters;
  parameters.tremor.rms = 0.05;
  return {parameters, plant::Intention::scripted(std::move(knots))};
}

plant::Hand scenario_hand() {
  const Eigen::Vector3d near = point_at_surface(kClearM);
  const Eigen::Vector3d pressed = point_at_surface(0.008);
  const Eigen::Vector3d pulled = point_at_surface(kClearM - 0.03);
  return hand_with({{0.0, home()},
                    {0.35, home()},
                    {0.6, near},
                    {0.75, pressed},
                    {0.85, pressed},
                    {1.0, near},
                    {1.05, near, true, plant::kGraspButton},
                    {1.4, pulled, true, plant::kGraspButton},
                    {1.5, pulled},
                    {1.8, home()},
                    {2.0, home()}});
}

}  // namespace palpate::fault
