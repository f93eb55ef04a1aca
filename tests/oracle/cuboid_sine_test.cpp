// The paper's second experiment: one end of the bar held, a corner of the other driven by a sine. The core
// beside the reference, tick by tick, and the peak force against a static solution.
#include <gtest/gtest.h>

#include "oracle/paper_bar.hpp"
#include "reference/static_solver.hpp"
#include "support/bodies.hpp"
#include "support/forests.hpp"

namespace palpate::test {
namespace {

using PaperProfile = WithFullCorotation<CuboidPaper>;
using Eigen::Vector3d;

constexpr LatticePoint kDrivenCorner{16, 16, 48};
constexpr double kAmplitudeM = 0.050;

sim::ModelParameters bar(double density_kg_m3, int substeps) {
  sim::ModelParameters parameters;
  parameters.regions[0].density_kg_m3 = density_kg_m3;
  parameters.substeps = substeps;
  parameters.remesh.rotation = RotationCriterion::kFull;
  return parameters;
}

/// The tool at tick k: the driven corner, moved along y by 50 mm sin(0.072 k / slowness degrees).
TickInput sine_input(const sim::ModelParameters& parameters, double k, double slowness) {
  TickInput input = input_at_rest();
  const double y = kAmplitudeM * std::sin(0.072 * k / slowness / 57.29577951308232);
  input.tool = fixed_vector<Position>(Vector3d(0.5, 0.5 + y / parameters.edge_m, 1.5));
  input.close_grasp = true;
  return input;
}

struct Deviation {
  double position_m = 0.0;
  double force_n = 0.0;
  double peak_force_n = 0.0;
};

Deviation run_beside_reference(const sim::ModelParameters& parameters, int ticks) {
  const auto state = started<PaperProfile>(compile_model(parameters));
  const double edge = parameters.edge_m;
  reference::ReferenceBody body(reference::mesh_of(state->forest, edge), reference_parameters(parameters),
                                reference::held_nodes(state->forest, state->model.held));
  Deviation most;
  for (int k = 0; k < ticks; ++k) {
    const TickInput input = sine_input(parameters, k, 1.0);
    const TickOutput output = tick_once(*state, input);
    const Vector3d expected = body.tick(reference_input(input, edge));
    EXPECT_EQ(output.flags, static_cast<uint32_t>(TickFlag::kGrasping));
    const Vector3d reaction = doubles(output.reaction) * sim::newtons_per_unit(parameters);
    most.force_n = std::max(most.force_n, (reaction - expected).norm());
    most.peak_force_n = std::max(most.peak_force_n, reaction.norm());
    const reference::Positions x = reference::positions_of(state->forest, edge);
    for (uint32_t i = 0; i < x.size(); ++i) {
      most.position_m = std::max(most.position_m, (x[i] - body.position()[i]).norm());
    }
    if (testing::Test::HasFailure()) break;
  }
  std::printf("%d ticks: no node off by more than %.4f um, no force by more than %.5f mN; peak %.2f mN\n",
              ticks, most.position_m * 1e6, most.force_n * 1e3, most.peak_force_n * 1e3);
  testing::Test::RecordProperty("most_position_um", std::to_string(most.position_m * 1e6));
  testing::Test::RecordProperty("most_force_mN", std::to_string(most.force_n * 1e3));
  return most;
}

void expect_close(const sim::ModelParameters& parameters, int ticks) {
  const Deviation most = run_beside_reference(parameters, ticks);
  EXPECT_LT(most.position_m, 1e-6);
  EXPECT_LT(most.force_n, 0.05e-3);
}

TEST(CuboidSine, FollowsTheReferenceAtRho10) { expect_close(bar(10.0, 4), 600); }
TEST(CuboidSine, FollowsTheReferenceAtRho1000) { expect_close(bar(1000.0, 1), 600); }
TEST(FullCuboidSine, FollowsTheReferenceAtRho10) { expect_close(bar(10.0, 4), 10000); }
TEST(FullCuboidSine, FollowsTheReferenceAtRho1000) { expect_close(bar(1000.0, 1), 10000); }

/// The corner at +50 mm, at rest: the reaction of full corotation in doubles.
double static_peak_n() {
  const auto state = started<PaperProfile>(compile_model(bar(10.0, 4)));
  const uint16_t corner = node_at(state->forest, kDrivenCorner);
  reference::StaticProblem problem;
  problem.mesh = reference::mesh_of(state->forest, kEdgeM);
  problem.materials = {tissue()};
  for (const uint8_t held : reference::held_nodes(state->forest, state->model.held)) {
    problem.prescribed.push_back(held != 0);
  }
  problem.prescribed[corner] = true;
  problem.place = [&](double load, reference::Positions& x) {
    x[corner] = problem.mesh.rest[corner] + Vector3d(0, load * kAmplitudeM, 0);
  };
  const reference::StaticSolution solution = reference::solve_static(problem);
  EXPECT_TRUE(solution.converged);
  EXPECT_LT(solution.residual_n, 1e-10);
  std::printf("static: %.2f mN after %d Newton steps, residual %.1e N\n", solution.force[corner].norm() * 1e3,
              solution.iterations, solution.residual_n);
  return solution.force[corner].norm();
}

TEST(CuboidSine, StaticPeakIsThatOfCorotation) { EXPECT_NEAR(static_peak_n() / 49.9e-3, 1.0, 0.02); }

/// 20 times slower, a quarter of a period: inertia and drag are nearly gone.
TEST(FullCuboidSine, SlowPeakIsTheStaticOne) {
  constexpr double kSlowness = 20.0;
  const sim::ModelParameters parameters = bar(10.0, 4);
  const auto state = started<PaperProfile>(compile_model(parameters));
  TickOutput output{};
  for (int k = 0; k <= 25000; ++k) output = tick_once(*state, sine_input(parameters, k, kSlowness));
  const double peak = doubles(output.reaction).norm() * sim::newtons_per_unit(parameters);
  const double expected = static_peak_n();
  std::printf("slow run: %.3f mN, static %.3f mN\n", peak * 1e3, expected * 1e3);
  EXPECT_NEAR(peak / expected, 1.0, 0.02);
}

}  // namespace
}  // namespace palpate::test
