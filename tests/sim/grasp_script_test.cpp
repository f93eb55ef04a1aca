// The grasp scenario's script: where the arm goes, and what its encoders say.
#include "scenario/grasp_script.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "plant/premium.hpp"
#include "units.hpp"

namespace palpate::sim {
namespace {

Scenario grasp() {
  Scenario scenario = built_in_scenario("grasp");
  scenario.model.level = 6;
  complete_scenario(scenario);
  return scenario;
}

double distance_mm(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return 1e3 * std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

std::optional<Eigen::Vector3d> angles_at(const ToolPoint& point) {
  return plant::premium::inverse_kinematics(Eigen::Vector3d(point.position_m.data()));
}

TEST(GraspScript, StaysInsideTheJointLimits) {
  double least_deg = 360.0;
  for (const ToolPoint& point : grasp_path(grasp())) {
    const auto angles = angles_at(point);
    ASSERT_TRUE(angles.has_value());
    const double margin = plant::margin_to_limits(plant::premium::kLimits, *angles);
    least_deg = std::min(least_deg, plant::degrees(margin));
  }
  EXPECT_GT(least_deg, kLimitMarginDeg);
}

TEST(GraspScript, InverseKinematicsIsTheInverse) {
  for (const ToolPoint& point : grasp_path(grasp())) {
    const Eigen::Vector3d again = plant::premium::tool_position(*angles_at(point));
    EXPECT_LT(distance_mm({again[0], again[1], again[2]}, point.position_m), 1e-9);
  }
}

TEST(GraspScript, RoundingIsWithinACount) {
  const auto path = grasp_path(grasp());
  const auto rows = grasp_script(grasp());
  ASSERT_EQ(path.size(), rows.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Eigen::Vector3d counts = plant::encoder_counts(plant::premium::kEncoders, *angles_at(path[i]));
    for (std::size_t joint = 0; joint < 3; ++joint) {
      const double exact = counts[static_cast<Eigen::Index>(joint)];
      EXPECT_LT(std::abs(exact - rows[i].encoder_counts[joint]), 0.5 + 1e-9);
    }
  }
}

/// The fixed-point kinematics of the firmware, from the rounded counts, find the path again.
TEST(GraspScript, TheFirmwareSeesThePath) {
  constexpr double kResolutionMm = 0.03;
  const auto path = grasp_path(grasp());
  const auto rows = grasp_script(grasp());
  for (std::size_t i = 0; i < path.size(); ++i) {
    const auto& counts = rows[i].encoder_counts;
    const auto angles =
        phantom::joint_angles(phantom::premium::kPremium15, phantom::Counts{counts[0], counts[1], counts[2]});
    const auto seen = to_doubles(phantom::premium::tool_position(phantom::premium::posture(angles)));
    EXPECT_LT(distance_mm(seen, path[i].position_m), kResolutionMm) << i;
  }
}

TEST(GraspScript, TellsTheStory) {
  const Scenario scenario = grasp();
  const auto path = grasp_path(scenario);
  ASSERT_EQ(path.size(), 3800U);
  const auto& corner = path[500].position_m;
  EXPECT_FALSE(path[499].grasp_button);
  EXPECT_TRUE(path[500].grasp_button);
  EXPECT_EQ(distance_mm(path[300].position_m, corner), 0.0);
  EXPECT_NEAR(distance_mm(path[0].position_m, corner), 40.0, 1e-9);
  EXPECT_NEAR((path[1700].position_m[1] - corner[1]) * 1e3, 50.0, 1e-9);
  EXPECT_TRUE(path[3199].grasp_button);
  EXPECT_FALSE(path[3200].grasp_button);
  EXPECT_NEAR(distance_mm(path[3200].position_m, corner), 0.0, 1e-9);
}

TEST(GraspScript, MovesSmoothly) {
  const auto path = grasp_path(grasp());
  for (std::size_t i = 1; i < path.size(); ++i) {
    EXPECT_LT(distance_mm(path[i].position_m, path[i - 1].position_m), 0.3);  // 0.3 m/s
  }
}

TEST(GraspScript, CanBeCutShort) {
  Scenario scenario = grasp();
  scenario.ticks = 700;
  EXPECT_EQ(grasp_script(scenario).size(), 700U);
}

}  // namespace
}  // namespace palpate::sim
