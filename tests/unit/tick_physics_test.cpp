// What a body does over many ticks: momentum, symmetry, standing still, and two materials in series.
#include <gtest/gtest.h>

#include "support/bodies.hpp"
#include "support/forests.hpp"
#include "support/random.hpp"
#include "support/soak.hpp"

namespace palpate::test {
namespace {

using SmallProfile = WithFullCorotation<Small>;
using Eigen::Vector3d;

/// Momentum in the masses that the integrator uses (1 / impulse): only the rounding of velocities can change
/// it, half an LSB of 2^-36 a node, axis and substep. In this body K / mass is a power of two for many nodes,
/// so ties, which round up, are common: a bias of 0.12 LSB a substep, 4e-7 m/s2.
TEST(TickPhysics, AFreeBodyKeepsItsMomentum) {
  Random random(121);
  sim::ModelParameters parameters = coarse_bar(1000.0, 2);
  parameters.held = sim::HeldEnds::kNone;
  parameters.mass_damping_per_s = 0.0;
  const auto state = started<SmallProfile>(compile_model(parameters));
  const uint16_t nodes = state->forest.nodes.used();
  const auto momentum = [&] {
    Vector3d sum = Vector3d::Zero();
    for (uint32_t i = 0; i < nodes; ++i) {
      sum += doubles(state->forest.node.velocity[i]) / sim::to_double(state->solve.impulse[i]);
    }
    return sum;
  };
  double mass = 0.0;
  for (uint32_t i = 0; i < nodes; ++i) {
    mass += 1.0 / sim::to_double(state->solve.impulse[i]);
    state->forest.node.velocity[i] = fixed_vector<Velocity>(2e-3 * random.vector());
  }
  // It drifts slowly, so that it stays within the position limit.
  const Vector3d extra = momentum() / mass - Vector3d(5e-6, -3e-6, 2e-6);
  for (uint32_t i = 0; i < nodes; ++i) state->forest.node.velocity[i] -= fixed_vector<Velocity>(extra);
  const Vector3d before = momentum();
  const int ticks = in_soak(100000, 2000);
  for (int i = 0; i < ticks; ++i) ASSERT_EQ(tick_once(*state, input_at_rest()).flags, 0u);
  const double drift = (momentum() - before).cwiseAbs().maxCoeff() / mass;
  const double bound = 2.0 * ticks * std::ldexp(0.5, -36);
  std::printf("mean velocity drifts by %.1f LSB in %d ticks; rounding allows %.0f\n", std::ldexp(drift, 36),
              ticks, std::ldexp(bound, 36));
  EXPECT_LE(drift, bound);
  EXPECT_GT(before.norm() / mass, 1e-6);
}

/// Swings the free bar from a velocity field that the symmetry maps on itself, and compares each node with
/// its image. Ties round up and not away from zero, so an image is not bit for bit: a velocity that differs
/// by 1 LSB a tick (2^-36) moves an image by 244 LSB (2^-27) in 500 ticks.
void expect_symmetric(const Eigen::Matrix3i& symmetry) {
  constexpr double kBoundLsb = 500;
  Random random(122);
  sim::ModelParameters parameters = coarse_bar(1000.0, 1);
  parameters.held = sim::HeldEnds::kNone;
  const auto state = started<SmallProfile>(compile_model(parameters));
  auto& node = state->forest.node;
  const auto image = [&](uint16_t i) {
    const Eigen::Vector3i p = symmetry * Eigen::Vector3i(node.rest[i].x, node.rest[i].y, node.rest[i].z);
    return node_at(state->forest, LatticePoint{static_cast<int16_t>(p[0]), static_cast<int16_t>(p[1]),
                                               static_cast<int16_t>(p[2])});
  };
  const Eigen::Matrix3d map = symmetry.cast<double>();
  for (uint16_t i = 0; i < state->forest.nodes.used(); ++i) {
    ASSERT_NE(image(i), kNone);
    ASSERT_EQ(image(image(i)), i);
    if (image(i) < i) continue;
    const Vector3d v = 2e-3 * random.vector();
    const Vector3d own = image(i) == i ? Vector3d(0.5 * (v + map * v)) : v;
    node.velocity[i] = fixed_vector<Velocity>(own);
    node.velocity[image(i)] = fixed_vector<Velocity>(map * own);
  }
  double worst = 0.0;
  double largest = 0.0;
  for (int tick = 0; tick < 500; ++tick) {
    tick_once(*state, input_at_rest());
    for (uint16_t i = 0; i < state->forest.nodes.used(); ++i) {
      const Vector3d x = doubles(node.position[i]);
      worst = std::max(worst, (map * x - doubles(node.position[image(i)])).cwiseAbs().maxCoeff());
      largest = std::max(largest, (x - doubles(rest_position(node.rest[i]))).norm());
    }
  }
  std::printf("asymmetry %.0f LSB of position, at displacements of up to %.3f edges\n", std::ldexp(worst, 27),
              largest);
  EXPECT_LE(std::ldexp(worst, 27), kBoundLsb);
  EXPECT_GT(largest, 0.01);
}

TEST(TickPhysics, IsSymmetricUnderASwapOfXAndY) {
  expect_symmetric((Eigen::Matrix3i() << 0, 1, 0, 1, 0, 0, 0, 0, 1).finished());
}
TEST(TickPhysics, IsSymmetricUnderAMirrorInX) {
  expect_symmetric((Eigen::Matrix3i() << -1, 0, 0, 0, 1, 0, 0, 0, 1).finished());
}
TEST(TickPhysics, IsSymmetricUnderAMirrorInZ) {
  expect_symmetric((Eigen::Matrix3i() << 1, 0, 0, 0, 1, 0, 0, 0, -1).finished());
}
TEST(TickPhysics, IsSymmetricUnderAPointReflection) {
  expect_symmetric((Eigen::Matrix3i() << -1, 0, 0, 0, -1, 0, 0, 0, -1).finished());
}

/// A grasp of the free corner, moved by `displacement`.
TickInput at_corner(const Vector3d& displacement) {
  TickInput input = input_at_rest();
  input.tool = fixed_vector<Position>(Vector3d(0.5, 0.5, 1.5) + displacement);
  input.close_grasp = true;
  return input;
}

/// Pulled aside, settled, then held: it neither creeps nor rings.
TEST(TickPhysics, HeldStillNothingDrifts) {
  sim::ModelParameters parameters = coarse_bar(1000.0, 1);
  parameters.mass_damping_per_s = 6.0;
  const auto state = started<SmallProfile>(compile_model(parameters));
  for (int i = 0; i <= 200; ++i) tick_once(*state, at_corner(Vector3d(0.0, 0.002 * i, 0.0005 * i)));
  const TickInput held = at_corner(Vector3d(0.0, 0.4, 0.1));
  for (int i = 0; i < 10000; ++i) tick_once(*state, held);
  const auto settled = state->forest.node.position;
  int32_t most = 0;
  int32_t most_force = 0;
  const TickOutput first = tick_once(*state, held);
  for (int i = 0; i < in_soak(100000, 2000); ++i) {
    const TickOutput output = tick_once(*state, held);
    for (int axis = 0; axis < 3; ++axis) {
      most_force = std::max(most_force, std::abs(output.reaction[axis].raw() - first.reaction[axis].raw()));
      for (uint32_t k = 0; k < state->forest.nodes.used(); ++k) {
        most = std::max(most, std::abs(state->forest.node.position[k][axis].raw() - settled[k][axis].raw()));
      }
    }
  }
  std::printf("held still: positions move by at most %d LSB, the reaction by %d LSB\n", most, most_force);
  EXPECT_LE(most, 256);       // 0.12 um at 64 mm
  EXPECT_LE(most_force, 64);  // 4 uN
}

/// A bar that is bent slowly is felt smoothly: the change of its force hardly changes from tick to tick. With
/// rotations renewed in every second tick it quivered by 28 times as much.
TEST(TickPhysics, ABarThatIsBentDoesNotQuiver) {
  sim::ModelParameters parameters;
  parameters.substeps = 3;
  const auto state = started<CuboidPaper>(compile_model(parameters));
  constexpr int kStart = 500;
  constexpr int kTicks = 2500;
  Vector3d force = Vector3d::Zero();
  Vector3d change = Vector3d::Zero();
  double squares = 0.0;
  for (int i = 0; i < kTicks; ++i) {
    const double aside = 0.78 * std::sin(2.0 * 3.14159265 * i / (4.0 * kTicks));
    const Vector3d now = doubles(tick_once(*state, at_corner(Vector3d(0.0, aside, 0.0))).reaction);
    if (i > kStart) squares += (now - force - change).squaredNorm();
    change = now - force;
    force = now;
  }
  const double quiver = std::sqrt(squares / (kTicks - kStart));
  std::printf("bent: the force of %.4f quivers by %.2g\n", force.norm(), quiver);
  EXPECT_LT(quiver, 1e-5);
  EXPECT_GT(force.norm(), 0.01);
}

/// Two materials in series without lateral contraction: stress is e E1 E2 L / (L1 E2 + L2 E1).
TEST(TickPhysics, TwoRegionsPullLikeSpringsInSeries) {
  sim::ModelParameters parameters = coarse_bar(1000.0, 2);
  parameters.regions = {{500.0, 0.0, 1000.0}, {1500.0, 0.0, 500.0}};
  parameters.region_of_cube = {0, 1, 1};
  parameters.held = sim::HeldEnds::kBoth;
  parameters.mass_damping_per_s = 20.0;
  const auto state = started<SmallProfile>(compile_model(parameters));
  TickInput input = input_at_rest();
  const double pull = 0.03;
  for (int i = 1; i <= 3000; ++i) {
    input.hold_motion[1].translation =
        fixed_vector<Position>(Vector3d(0, 0, pull * std::min(1.0, i / 500.0)));
    ASSERT_EQ(tick_once(*state, input).flags, 0u);
  }
  double force = 0.0;
  for (uint32_t i = 0; i < state->forest.nodes.used(); ++i) {
    if (state->forest.node.rest[i].z == 48) force -= sim::to_double(state->forest.node.force[i][2]);
  }
  // In E_ref edge^2 with E_ref = 1500 Pa: lengths 1 and 2, moduli 1/3 and 1.
  EXPECT_NEAR(force, pull / (1.0 / (1.0 / 3.0) + 2.0), 1e-6);
  const double interface = pull * 3.0 / 5.0;
  for (uint32_t i = 0; i < state->forest.nodes.used(); ++i) {
    const LatticePoint rest = state->forest.node.rest[i];
    if (rest.z != -16) continue;
    EXPECT_NEAR(sim::to_double(state->forest.node.position[i][2]), -0.5 + interface, 1e-6);
  }
}

}  // namespace
}  // namespace palpate::test
