// The parts of `palpate paper` that turn runs into figures.
#include <cmath>
#include <fstream>

#include "paper/mesh_error.hpp"
#include "paper/model_sine.hpp"
#include "paper/parallel.hpp"
#include "paper/rest_solution.hpp"
#include "paper/smoothness.hpp"
#include "program.hpp"

namespace palpate::test {
namespace {

using Forces = std::vector<std::array<double, 3>>;

TEST(Smoothness, FindsTheLargestStepAndSecondDifference) {
  const Forces force_n = {{0, 0, 0}, {0.004, 0.003, 0}, {0, 0, 0}, {0.001, 0, 0}, {0.002, 0, 0}};
  const sim::Smoothness all = sim::smoothness_of(force_n, 0);
  EXPECT_NEAR(all.step_mn, 5.0, 1e-9);
  EXPECT_NEAR(all.second_difference_mn, 10.0, 1e-9);
  const sim::Smoothness late = sim::smoothness_of(force_n, 2);
  EXPECT_NEAR(late.step_mn, 1.0, 1e-9);
  EXPECT_NEAR(late.second_difference_mn, 0.0, 1e-9);
  EXPECT_EQ(sim::smoothness_of({}, 0).step_mn, 0.0);
  const sim::ChartPoints steps = sim::steps_over_time(force_n, 2);
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_NEAR(steps[0][1], 5.0, 1e-9);
  EXPECT_NEAR(steps[1][1], 1.0, 1e-9);
}

/// The corners of a cube of 1 mm cut into six tets around its main diagonal, and its middle.
sim::BodyFields cube() {
  sim::BodyFields body;
  for (uint32_t i = 0; i < 8; ++i)
    body.rest_mm.push_back({i & 1u ? 1.0 : 0.0, i & 2u ? 1.0 : 0.0, i & 4u ? 1.0 : 0.0});
  for (const auto& [a, b] : {std::pair{1u, 3u}, {3u, 2u}, {2u, 6u}, {6u, 4u}, {4u, 5u}, {5u, 1u}}) {
    body.tets.push_back({0, a, b, 7});
  }
  body.now_mm = body.rest_mm;
  return body;
}

TEST(MeshError, InterpolatesTheCoarseBody) {
  sim::BodyFields coarse = cube();
  for (auto& p : coarse.now_mm) p[2] += 0.1 * p[0];
  sim::BodyFields fine = coarse;
  fine.rest_mm.push_back({0.5, 0.25, 0.75});
  fine.now_mm.push_back({0.5, 0.25, 0.75 + 0.05 + 0.3});
  std::vector<bool> is_free(9, true);
  const sim::MeshError error = sim::error_of(coarse, fine, is_free);
  EXPECT_NEAR(error.max_mm, 0.3, 1e-12);
  EXPECT_NEAR(error.mean_mm, 0.3 / 9.0, 1e-12);
  is_free[8] = false;
  EXPECT_NEAR(sim::error_of(coarse, fine, is_free).max_mm, 0.0, 1e-12);
}

TEST(MeshError, RefusesAMeshWithAHole) {
  sim::BodyFields coarse = cube();
  coarse.tets.resize(1);
  EXPECT_THROW(sim::error_of(coarse, cube(), std::vector<bool>(8, true)), std::logic_error);
}

TEST(InParallel, KeepsTheOrderAndThrowsTheFirstFailure) {
  std::vector<int> items(100);
  for (int i = 0; i < 100; ++i) items[static_cast<std::size_t>(i)] = i;
  const std::vector<int> squares = sim::in_parallel(items, [](int i) { return i * i; });
  for (int i = 0; i < 100; ++i) EXPECT_EQ(squares[static_cast<std::size_t>(i)], i * i);
  const auto fail_at_50 = [](int i) {
    if (i == 50) throw std::runtime_error("50");
    return i;
  };
  EXPECT_THROW(sim::in_parallel(items, fail_at_50), std::runtime_error);
}

sim::Scenario coarse_sine(double amplitude_mm) {
  sim::Scenario scenario = sim::built_in_scenario("cuboid-sine");
  scenario.model.level = 3;
  scenario.model.substeps = 2;
  scenario.sine.amplitude_mm = amplitude_mm;
  scenario.ticks = 400;
  sim::complete_scenario(scenario);
  return scenario;
}

double distance(const Forces& a, const Forces& b) {
  double most = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    most = std::max(most, std::hypot(a[k][0] - b[k][0], a[k][1] - b[k][1], a[k][2] - b[k][2]));
  }
  return most;
}

/// All three models are the same to first order, and not beyond.
TEST(SlowModelSine, ModelsAgreeForASmallMotionOnly) {
  using reference::ElasticModel;
  const auto force_of = [](double amplitude_mm, ElasticModel model) {
    return sim::trace_model(coarse_sine(amplitude_mm), model).force_n;
  };
  const Forces small = force_of(0.01, ElasticModel::kLinear);
  const double scale_n = distance(small, Forces(small.size(), {0, 0, 0}));
  EXPECT_LT(distance(small, force_of(0.01, ElasticModel::kCorotation)), 1e-3 * scale_n);
  EXPECT_LT(distance(small, force_of(0.01, ElasticModel::kStVenantKirchhoff)), 1e-3 * scale_n);
  const Forces large = force_of(50.0, ElasticModel::kLinear);
  EXPECT_GT(distance(large, force_of(50.0, ElasticModel::kStVenantKirchhoff)), 100.0 * scale_n);
}

/// What `run --rest-at-peak on` ends with is the equilibrium that the reference finds.
TEST(SlowRestSolution, IsWhereARunComesToRest) {
  const TemporaryFolder folder;
  const Outcome outcome = run_program(
      folder,
      "run cuboid-sine --rest-at-peak on --rotations full --profile workstation --level 3 --substeps 2 "
      "--plots off --out run");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const sim::RestSolution rest = sim::solve_rest(coarse_sine(50.0));
  std::ifstream rows(folder / "run/nodes.csv");
  std::string line;
  std::getline(rows, line);
  for (std::size_t i = 0; i < rest.body.now_mm.size(); ++i) {
    ASSERT_TRUE(std::getline(rows, line));
    std::array<double, 3> now{};
    unsigned node = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%u,%*f,%*f,%*f,%lf,%lf,%lf", &node, &now[0], &now[1], &now[2]), 4);
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(now[axis], rest.body.now_mm[i][axis], 0.01) << line;
  }
}

}  // namespace
}  // namespace palpate::test
