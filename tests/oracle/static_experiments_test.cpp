// The paper's two experiments, static, in three models. The figures are those of an independent computation.
#include <gtest/gtest.h>

#include "oracle/paper_bar.hpp"
#include "reference/experiments.hpp"
#include "reference/mesh_from_forest.hpp"
#include "reference/quadratic_tets.hpp"
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

constexpr double kLengthM = 3 * kEdgeM;

Mesh bar(uint8_t level = 6) {
  const auto forest = roots_of<Deep>(bar_block());
  EXPECT_EQ(refine_uniformly(*forest, level), MeshStatus::kDone);
  return reference::mesh_of(*forest, kEdgeM);
}

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

/// A bend so small that all models agree; stiffness = 2 energy / angle^2.
StaticProblem small_bend(const Mesh& mesh, double poisson_ratio) {
  StaticProblem problem = reference::bend_problem(mesh, reference::material_of(500.0, poisson_ratio, 10.0),
                                                  1e-4, BendFrame::kMiddle, 1);
  problem.model = ElasticModel::kLinear;
  return problem;
}

double bending_energy(const StaticProblem& problem) {
  const StaticSolution solution = reference::solve_static(problem);
  EXPECT_TRUE(solution.converged);
  return static_energy(reference::elements_of(problem.mesh), problem.materials, solution.x, problem.model);
}

double quadratic_bending_energy(const Mesh& mesh, double poisson_ratio) {
  const reference::QuadraticBody body = reference::quadratic_body(mesh);
  const StaticProblem problem = small_bend(body.mesh, poisson_ratio);
  const StaticSolution solution = solve_static(problem, body.elements);
  EXPECT_TRUE(solution.converged);
  return static_energy(body.elements, problem.materials, solution.x, problem.model);
}

/// How much too stiff linear tets are in bending, against quadratic ones on the mesh of level 6.
TEST(VolumeLocking, OfLinearTets) {
  const double soft = quadratic_bending_energy(bar(), 0.49);
  const auto excess = [&](uint8_t level) {
    return bending_energy(small_bend(bar(level), 0.49)) / soft - 1.0;
  };
  const double at_3 = excess(3);
  const double at_6 = excess(6);
  const double at_9 = excess(9);
  std::printf("too stiff at level 3, 6, 9: %+.1f %% %+.1f %% %+.1f %%\n", 100 * at_3, 100 * at_6, 100 * at_9);
  EXPECT_NEAR(at_3, 0.70, 0.04);
  EXPECT_NEAR(at_6, 0.22, 0.015);
  EXPECT_NEAR(at_9, 0.06, 0.01);
  EXPECT_NEAR(bending_energy(small_bend(bar(), 0.3)) / quadratic_bending_energy(bar(), 0.3) - 1.0, 0.16,
              0.015);
}

}  // namespace
}  // namespace palpate::test
