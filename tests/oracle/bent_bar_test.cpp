// The paper's first experiment: one end face held, the other turned by 90 degrees on an arc that keeps the
// centre line's length. The core, settled, against the static solution of the reference.
#include <gtest/gtest.h>

#include "oracle/paper_bar.hpp"
#include "reference/experiments.hpp"
#include "support/bodies.hpp"
#include "support/forests.hpp"

namespace palpate::test {
namespace {

using PaperProfile = WithFullCorotation<CuboidPaper>;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kLengthEdges = 3.0;

/// A cross-section of a bar bent into an arc of `angle` in the x-z plane, lengths in edges.
struct Section {
  Matrix3d rotation;
  Vector3d centre;
};

Section section_at(double s, double angle) {  // s: arc length from the held end
  if (angle == 0.0) return Section{Matrix3d::Identity(), Vector3d(0, 0, s - kLengthEdges / 2)};
  const double radius = kLengthEdges / angle;
  const double a = s / radius;
  return Section{Eigen::AngleAxisd(a, Vector3d::UnitY()).toRotationMatrix(),
                 Vector3d(radius * (1.0 - std::cos(a)), 0.0, radius * std::sin(a) - kLengthEdges / 2)};
}

/// x = R x0 + t for the far end face.
RigidMotion end_motion(double angle) {
  const Section section = section_at(kLengthEdges, angle);
  return RigidMotion{
      fixed_matrix<RotationEntry>(section.rotation),
      fixed_vector<Position>(section.centre - section.rotation * Vector3d(0, 0, kLengthEdges / 2))};
}

sim::ModelParameters core_bar() {
  sim::ModelParameters parameters;
  parameters.remesh.rotation = RotationCriterion::kFull;
  parameters.held = sim::HeldEnds::kBoth;
  parameters.mass_damping_per_s = 25.0;
  return parameters;
}

reference::StaticSolution static_bend(const State<PaperProfile>& state, double edge_m) {
  return reference::solve_static(reference::bend_problem(reference::mesh_of(state.forest, edge_m), tissue(),
                                                         kQuarterTurn, reference::BendFrame::kHeldEnd));
}

TEST(BentBar, StaticSolutionConverges) {
  const sim::ModelParameters parameters = core_bar();
  const auto state = started<PaperProfile>(compile_model(parameters));
  const reference::StaticSolution solution = static_bend(*state, parameters.edge_m);
  ASSERT_TRUE(solution.converged);
  EXPECT_LT(solution.residual_n, 1e-10);
  const double change =
      reference::volume_change(reference::mesh_of(state->forest, parameters.edge_m), solution.x);
  std::printf("%d Newton steps, residual %.1e N, volume %+.2f %%\n", solution.iterations, solution.residual_n,
              100.0 * change);
  EXPECT_NEAR(change, -0.021, 0.002);
}

TEST(FullBentBar, SettlesWhereTheReferenceDoes) {
  const sim::ModelParameters parameters = core_bar();
  const auto state = started<PaperProfile>(compile_model(parameters));
  TickInput input = input_at_rest();
  for (int k = 1; k <= 2000; ++k) {
    input.hold_motion[1] = end_motion(kQuarterTurn * k / 2000.0);
    EXPECT_EQ(tick_once(*state, input).flags, 0u);
  }
  for (int k = 0; k < 4000; ++k) EXPECT_EQ(tick_once(*state, input).flags, 0u);
  const reference::StaticSolution solution = static_bend(*state, parameters.edge_m);
  ASSERT_TRUE(solution.converged);
  const reference::Positions x = reference::positions_of(state->forest, parameters.edge_m);
  double most = 0.0;
  for (uint32_t i = 0; i < x.size(); ++i) most = std::max(most, (x[i] - solution.x[i]).norm());
  std::printf("settled: no node off by more than %.3f um\n", most * 1e6);
  RecordProperty("most_position_um", std::to_string(most * 1e6));
  EXPECT_LT(most, 5e-6);
}

}  // namespace
}  // namespace palpate::test
