// Elastic forces of whole bodies: none without deformation, no net force ever, and a bar that pulls like a
// bar.
#include <gtest/gtest.h>

#include "support/bodies.hpp"
#include "support/forests.hpp"
#include "support/random.hpp"

namespace palpate::test {
namespace {

using DenseProfile = WithFullCorotation<CuboidDense>;
using Eigen::Matrix3d;
using Eigen::Vector3d;

std::unique_ptr<State<DenseProfile>> bar(int level, double nu) {
  sim::ModelParameters parameters;
  parameters.level = level;
  parameters.regions[0] = {500.0, nu, 1000.0};
  parameters.substeps = 1;
  parameters.remesh.rotation = RotationCriterion::kFull;
  return started<DenseProfile>(compile_model(parameters));
}

template <class Map>
void place(State<DenseProfile>& state, Map map) {
  for (uint32_t i = 0; i < state.forest.nodes.used(); ++i) {
    const uint16_t node = state.forest.nodes.live(i);
    const Vector3d x = map(doubles(rest_position(state.forest.node.rest[node])));
    state.forest.node.position[node] = fixed_vector<Position>(x);
  }
}

double largest_force(const State<DenseProfile>& state) {
  double largest = 0.0;
  for (uint32_t i = 0; i < state.forest.nodes.used(); ++i) {
    largest =
        std::max(largest, doubles(state.forest.node.force[state.forest.nodes.live(i)]).cwiseAbs().maxCoeff());
  }
  return largest;
}

void update(State<DenseProfile>& state, int rotation_steps) {
  for (int i = 0; i < rotation_steps; ++i) {
    evaluate_forces(state);
    update_rotations(state.front, state.groups);
  }
  evaluate_forces(state);
}

/// At rest exactly zero: every product is exact there.
TEST(BodyForce, IsZeroAtRest) {
  for (const int level : {0, 1, 2, 3, 4, 5, 6}) {
    const auto state = bar(level, 0.49);
    update(*state, 3);
    EXPECT_EQ(largest_force(*state), 0.0) << level;
  }
}

/// Turned by any angle in steps that the extraction follows. Rounded positions are strains of some 2^(size -
/// 27), which the bulk coefficient (5.5) and the sums at a node make some LSB of force.
TEST(BodyForce, IsNearlyZeroAfterARigidMotion) {
  Random random(81);
  for (const int level : {3, 5, 6}) {
    double worst = 0.0;
    for (int round = 0; round < 5; ++round) {
      const auto state = bar(level, 0.49);
      const Vector3d axis = random.direction();
      const Vector3d shift = random.vector();
      const double angle = 3.0 * random.unit();
      for (int step = 1; step <= 20; ++step) {
        const Matrix3d r = Eigen::AngleAxisd(angle * step / 20.0, axis).toRotationMatrix();
        place(*state, [&](const Vector3d& x0) { return Vector3d(r * x0 + shift); });
        update(*state, 2);
      }
      worst = std::max(worst, largest_force(*state));
    }
    std::printf("level %d: %.1f LSB after a rigid motion\n", level, worst / kForceLsb);
    EXPECT_LE(worst, 16 * kForceLsb);
  }
}

/// Integer sums: exactly zero in any state.
TEST(BodyForce, SumsToExactlyZero) {
  Random random(82);
  for (const int level : {2, 4, 6}) {
    const auto state = bar(level, 0.49);
    place(*state, [&](const Vector3d& x0) { return Vector3d(x0 + 0.1 * random.vector()); });
    update(*state, 1);
    int64_t sum[3] = {0, 0, 0};
    for (uint32_t i = 0; i < state->forest.nodes.used(); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        sum[axis] += state->forest.node.force[state->forest.nodes.live(i)][axis].raw();
      }
    }
    for (const int64_t component : sum) EXPECT_EQ(component, 0);
    EXPECT_GT(largest_force(*state), 0.0);
  }
}

/// Stretched by e with free sides, the end faces pull with E e A and nothing else is loaded.
TEST(BodyForce, OfAStretchedBarIsYoungsModulus) {
  for (const double nu : {0.0, 0.3, 0.49}) {
    for (const int level : {2, 3, 5, 6}) {
      const auto state = bar(level, nu);
      const double e = 0.02;
      place(*state, [&](const Vector3d& x0) {
        return Vector3d(x0[0] * (1 - nu * e), x0[1] * (1 - nu * e), x0[2] * (1 + e));
      });
      update(*state, 2);
      double pull = 0.0;
      double elsewhere = 0.0;
      for (uint32_t i = 0; i < state->forest.nodes.used(); ++i) {
        const uint16_t node = state->forest.nodes.live(i);
        const Vector3d f = doubles(state->forest.node.force[node]);
        const bool top = state->forest.node.rest[node].z == 48;
        const bool bottom = state->forest.node.rest[node].z == -48;
        pull += top ? -f[2] : 0.0;
        elsewhere =
            std::max({elsewhere, std::abs(f[0]), std::abs(f[1]), top || bottom ? 0.0 : std::abs(f[2])});
      }
      EXPECT_NEAR(pull / e, 1.0, 1e-4) << "nu " << nu << " level " << level;
      EXPECT_LT(elsewhere, 24 * kForceLsb);
    }
  }
}

}  // namespace
}  // namespace palpate::test
