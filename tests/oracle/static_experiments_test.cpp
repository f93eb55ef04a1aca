// The paper's two experiments, static, in three models. The figures are those of an independent computation.
#include <gtest/gtest.h>

#include "reference/experiments.hpp"
#include "reference/mesh_from_forest.hpp"
#include "support/forests.hpp"

namespace palpate::test {
namespace {

using reference::BendFrame;
using reference::Distance;
using reference::ElasticModel;
using reference::Mesh;
using reference::Positions;
using reference::StaticProblem;
using reference::StaticSolution;

constexpr double kQuarterTurn = 1.5707963267948966;
constexpr double kEdgeM = 0.064;
constexpr double kLengthM = 3 * kEdgeM;

Mesh bar() {
  const auto forest = roots_of<Bar>(bar_block());
  EXPECT_EQ(refine_uniformly(*forest, 6), MeshStatus::kDone);
  return reference::mesh_of(*forest, kEdgeM);
}

reference::Material tissue() { return reference::material_of(500.0, 0.49, 10.0); }

Positions bent(const Mesh& mesh, ElasticModel model, BendFrame frame) {
  StaticProblem problem = reference::bend_problem(mesh, tissue(), kQuarterTurn, frame);
  problem.model = model;
  const StaticSolution solution = reference::solve_static(problem);
  EXPECT_TRUE(solution.converged);
  return frame == BendFrame::kHeldEnd ? solution.x
                                      : reference::in_held_end_frame(solution.x, kLengthM, kQuarterTurn);
}

TEST(Bend, ErrorsAndVolumesOfTheModels) {
  const Mesh mesh = bar();
  const Positions nonlinear = bent(mesh, ElasticModel::kStVenantKirchhoff, BendFrame::kMiddle);
  const Positions linear = bent(mesh, ElasticModel::kLinear, BendFrame::kHeldEnd);
  const Positions corotated = bent(mesh, ElasticModel::kCorotation, BendFrame::kHeldEnd);
  const auto prescribed =
      reference::bend_problem(mesh, tissue(), kQuarterTurn, BendFrame::kHeldEnd).prescribed;
  const Distance of_linear = reference::distance_of(linear, nonlinear, prescribed);
  EXPECT_NEAR(of_linear.mean_mm, 26.25, 0.01);
  EXPECT_NEAR(of_linear.max_mm, 42.6, 0.1);
  EXPECT_NEAR(of_linear.min_mm, 3.20, 0.01);
  const Distance of_corotation = reference::distance_of(corotated, nonlinear, prescribed);
  EXPECT_NEAR(of_corotation.mean_mm, 2.99, 0.01);
  EXPECT_NEAR(of_corotation.max_mm, 5.41, 0.01);
  EXPECT_NEAR(reference::volume_change(mesh, linear), 0.41, 0.01);
  EXPECT_NEAR(reference::volume_change(mesh, nonlinear), -0.044, 0.001);
  EXPECT_NEAR(reference::volume_change(mesh, corotated), -0.021, 0.001);
}

TEST(Bend, OfCorotationIsTheSameInBothFrames) {
  const Mesh mesh = bar();
  const Positions a = bent(mesh, ElasticModel::kCorotation, BendFrame::kHeldEnd);
  const Positions b = bent(mesh, ElasticModel::kCorotation, BendFrame::kMiddle);
  for (uint32_t i = 0; i < a.size(); ++i) EXPECT_LT((a[i] - b[i]).norm(), 1e-9);
}

double corner_force_mn(const Mesh& mesh, ElasticModel model) {
  StaticProblem problem = reference::corner_problem(mesh, tissue(), 0.05);
  problem.model = model;
  const StaticSolution solution = reference::solve_static(problem);
  EXPECT_TRUE(solution.converged);
  return 1e3 * solution.force[reference::node_nearest(mesh, reference::upper_corner(mesh))].norm();
}

TEST(DrivenCorner, ForceOfTheModels) {
  const Mesh mesh = bar();
  EXPECT_NEAR(corner_force_mn(mesh, ElasticModel::kLinear), 32.3, 0.1);
  EXPECT_NEAR(corner_force_mn(mesh, ElasticModel::kStVenantKirchhoff), 65.4, 0.1);
  EXPECT_NEAR(corner_force_mn(mesh, ElasticModel::kCorotation), 49.9, 0.1);
}

}  // namespace
}  // namespace palpate::test
