// A free body that re-meshes all the time, with many tethers at once: its momentum stays, and neither a
// change of the mesh nor a release adds kinetic energy.
#include <gtest/gtest.h>

#include "support/random.hpp"
#include "support/remeshing.hpp"
#include "support/soak.hpp"

namespace palpate::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Flying : TestProfile<1152, 512, 6> {
  static constexpr uint16_t kGroups = 300;
};

/// Velocities in their LSB, so that a momentum is mass units times LSB.
Vector3d raw(const Vector3<Velocity>& v) { return Vector3d(v[0].raw(), v[1].raw(), v[2].raw()); }

/// Nothing holds it and no drag slows it. Bent, stretched, in flight, turning and quivering.
std::unique_ptr<State<Flying>> flying_bar(Random& random) {
  sim::ModelParameters parameters = remeshing_bar();
  parameters.held = sim::HeldEnds::kNone;
  parameters.mass_damping_per_s = 0.0;
  parameters.remesh.stretch_split = 0.04;
  auto state = started<Flying>(compile_model(parameters));
  const Matrix3d r = random.rotation();
  const Matrix3d stretch = Matrix3d::Identity() + 0.05 * random.matrix();
  const Vector3d wave = 2.0 * random.vector();
  const Vector3d amplitude = 0.05 * random.vector();
  const Vector3d flight = 2e-4 * random.vector();
  const Vector3d spin = 2e-3 * random.vector();
  const Matrix3d quiver = 1e-3 * random.matrix();
  for (uint32_t i = 0; i < state->forest.nodes.used(); ++i) {
    const uint16_t node = state->forest.nodes.live(i);
    const Vector3d x0 = doubles(rest_position(state->forest.node.rest[node]));
    const Vector3d x = r * (stretch * x0 + amplitude * std::sin(wave.dot(x0)));
    state->forest.node.position[node] = state->solve.force_position[node] = fixed_vector<Position>(x);
    state->forest.node.velocity[node] = fixed_vector<Velocity>(flight + spin.cross(x) + quiver * x);
  }
  for (uint32_t i = 0; i < state->front.groups.used(); ++i) {
    const uint16_t group = state->front.groups.live(i);
    state->groups.used[group] = state->groups.extracted[group] = fixed_quaternion(r);
  }
  return state;
}

struct Sums {
  Vector3d momentum = Vector3d::Zero();
  Vector3d angular = Vector3d::Zero();  // about the origin
  double angular_size = 0.0;            // sum of what the nodes have of it, whatever its direction
  double energy = 0.0;
  double mass = 0.0;
  double heaviest = 0.0;
  double fastest = 0.0;  // |vx| + |vy| + |vz|
};

Sums sums_of(const State<Flying>& state) {
  Sums sums;
  for (uint32_t i = 0; i < state.forest.nodes.used(); ++i) {
    const uint16_t node = state.forest.nodes.live(i);
    const double mass = state.forest.node.mass[node];
    const Vector3d v = raw(state.forest.node.velocity[node]);
    sums.momentum += mass * v;
    const Vector3d angular = mass * doubles(state.forest.node.position[node]).cross(v);
    sums.angular += angular;
    sums.angular_size += angular.norm();
    sums.energy += 0.5 * mass * v.squaredNorm();
    sums.mass += mass;
    sums.heaviest = std::max(sums.heaviest, mass);
    sums.fastest = std::max(sums.fastest, v.lpNorm<1>());
  }
  return sums;
}

/// What rounding does to the momentum. All forces together are zero to the last bit; so with w = K / m
/// exactly and no rounding of velocities nothing would change at all. But a velocity is rounded by half an
/// LSB, and w is rounded too, so that a substep changes the momentum by
///   sum of (m w - K) f  +  at most sum of m / 2.
struct Rounding {
  Vector3d by_impulses = Vector3d::Zero();
  double most = 0.0;      // of what roundings of velocities can do to a component
  double variance = 0.0;  // of it, were they dice

  void add_substep(const State<Flying>& state) {
    const Dynamics& dynamics = state.model.dynamics;
    const double k = std::ldexp(sim::to_double(dynamics.impulse_mantissa), dynamics.impulse_exponent);
    Vector3<Force> sum = zero_vector<Force>();
    for (uint32_t i = 0; i < state.forest.nodes.used(); ++i) {
      const uint16_t node = state.forest.nodes.live(i);
      const double mass = state.forest.node.mass[node];
      const double off = mass * sim::to_double(state.solve.impulse[node]) - k;
      by_impulses += std::ldexp(off, Velocity::kFractionBits) * doubles(state.forest.node.force[node]);
      most += 0.5 * mass;
      variance += mass * mass / 12.0;
      sum += state.forest.node.force[node];
    }
    ASSERT_EQ(sum, zero_vector<Force>());
  }
  /// A new node's velocity is a rounded mean; a removed one's momentum goes to two velocities, each rounded
  /// and off by 2^-30 of the difference.
  void add_changes(const Changes& made, const Sums& sums) {
    const double roundings = made.patches_split + 2.0 * made.patches_merged;
    most += roundings * sums.heaviest * (0.5 + std::ldexp(sums.fastest, -29));
    variance += roundings * sums.heaviest * sums.heaviest / 12.0;
  }
};

/// What the forces as they are now do to the angular momentum in a substep.
Vector3d angular_kick(const State<Flying>& state) {
  const Dynamics& dynamics = state.model.dynamics;
  const double k = std::ldexp(sim::to_double(dynamics.impulse_mantissa), dynamics.impulse_exponent);
  Vector3d torque = Vector3d::Zero();
  for (uint32_t i = 0; i < state.forest.nodes.used(); ++i) {
    const uint16_t node = state.forest.nodes.live(i);
    torque += doubles(state.forest.node.position[node]).cross(doubles(state.forest.node.force[node]));
  }
  return std::ldexp(k, Velocity::kFractionBits) * torque;
}

/// Kinetic energy after the kick of the forces as they are now, with the masses that the integrator has.
double energy_after_kick(const State<Flying>& state, double& lsb) {
  double energy = 0.0;
  lsb = 0.0;
  for (uint32_t i = 0; i < state.forest.nodes.used(); ++i) {
    const uint16_t node = state.forest.nodes.live(i);
    const double w = sim::to_double(state.solve.impulse[node]);
    const Vector3d v = doubles(state.forest.node.velocity[node]) + w * doubles(state.forest.node.force[node]);
    energy += v.squaredNorm() / (2.0 * w);
    lsb += std::ldexp(v.lpNorm<1>(), -Force::kFractionBits);
  }
  return energy;
}

class Flight {
 public:
  explicit Flight(uint64_t seed) : random_(seed), state_(flying_bar(random_)), watch_(*state_) {}

  void run(uint32_t ticks) {
    const Sums before = sums_of(*state_);
    for (uint32_t i = 0; i < ticks && !testing::Test::HasFatalFailure(); ++i) tick();
    const Sums after = sums_of(*state_);
    ASSERT_EQ(state_->clamps.speed + state_->clamps.position, 0u);
    ASSERT_EQ(after.mass, before.mass);
    const Vector3d change = after.momentum - before.momentum;
    const double unexplained = (change - rounding_.by_impulses).cwiseAbs().maxCoeff();
    of_bound = unexplained / rounding_.most;
    of_dice = unexplained / std::sqrt(rounding_.variance);
    velocity_lsb = change.cwiseAbs().maxCoeff() / after.mass;
    angular = (after.angular - before.angular).norm() / before.angular_size;
    angular_by_elasticity = by_elasticity_.norm() / before.angular_size;
    angular_by_tethers = by_tethers_.norm() / before.angular_size;
    ASSERT_NO_FATAL_FAILURE(expect_whole(*state_));
  }

  Changes all{};
  uint32_t most_tethers = 0;
  double of_bound = 0.0, of_dice = 0.0, velocity_lsb = 0.0;
  double angular = 0.0, angular_by_elasticity = 0.0, angular_by_tethers = 0.0;
  double worst_change = -1e300;   // of kinetic energy by a change of the mesh, in what rounding explains
  double worst_release = -1e300;  // the same by a release, in LSB of force

 private:
  void tick() {
    change_the_mesh();
    tick_stages::rotations<true>(*state_);
    tick_stages::forces<Observe::kYes>(*state_);
    const Vector3d elastic = angular_kick(*state_);
    add_tethers();
    by_elasticity_ += elastic;
    by_tethers_ += angular_kick(*state_) - elastic;
    ASSERT_NO_FATAL_FAILURE(rounding_.add_substep(*state_));
    const HoldMotions still = {RigidMotion::identity(), RigidMotion::identity()};
    integrate_first(state_->forest, state_->model.dynamics, still, state_->driven, state_->solve,
                    state_->clamps);
    ++state_->tick;
  }

  void change_the_mesh() {
    const Sums before = sums_of(*state_);
    change_fronts(*state_);
    const Changes made = watch_.changes();
    const Sums after = sums_of(*state_);
    Sums most = before;
    most.heaviest = std::max(before.heaviest, after.heaviest);
    rounding_.add_changes(made, most);
    all.patches_split += made.patches_split;
    all.patches_merged += made.patches_merged;
    const double roundings = made.patches_split + 2.0 * made.patches_merged;
    if (roundings == 0.0) return;
    const double bound = roundings * 0.51 * most.heaviest * (most.fastest + 1.0);
    worst_change = std::max(worst_change, (after.energy - before.energy) / bound);
  }

  /// In the order of the list, as the tick does it, with a look at the energy around each release.
  void add_tethers() {
    most_tethers = std::max<uint32_t>(most_tethers, state_->tethers.count);
    TetherForces<Flying> forces(state_->forest, state_->solve, kNone);
    for (uint32_t i = 0; i < state_->tethers.count; ++i) {
      const Tether& tether = state_->tethers.tether[i];
      double lsb = 0.0;
      const double before = energy_after_kick(*state_, lsb);
      forces.add(tether, tether.ticks_left);
      if (tether.kind != TetherKind::kRelease) continue;
      worst_release = std::max(worst_release, (energy_after_kick(*state_, lsb) - before) / lsb);
    }
  }

  Random random_;
  std::unique_ptr<State<Flying>> state_;
  ChangeWatch<Flying> watch_;
  Rounding rounding_;
  Vector3d by_elasticity_ = Vector3d::Zero();
  Vector3d by_tethers_ = Vector3d::Zero();
};

TEST(RemeshMomentum, AFreeBodyKeepsItsMomentum) {
  uint32_t split = 0;
  uint32_t merged = 0;
  for (uint64_t seed = 0; seed < in_soak(200u, 6u); ++seed) {
    Flight flight(seed);
    ASSERT_NO_FATAL_FAILURE(flight.run(1000));
    std::printf(
        "%u patches split, %u merged, up to %u tethers: mean velocity off by %.1f LSB; of it not explained "
        "by "
        "impulses %.5f of the bound on rounding, %.2f sigma of dice; angular momentum off by %.0e, %.0e by "
        "elasticity, %.0e by tethers\n",
        flight.all.patches_split, flight.all.patches_merged, flight.most_tethers, flight.velocity_lsb,
        flight.of_bound, flight.of_dice, flight.angular, flight.angular_by_elasticity,
        flight.angular_by_tethers);
    std::printf("  kinetic energy at most %+.3g of rounding by a change, %+.3f LSB of force by a release\n",
                flight.worst_change, flight.worst_release);
    EXPECT_LE(flight.of_bound, 1.0);
    EXPECT_LE(flight.of_dice, 6.0);
    EXPECT_LE(flight.worst_change, 1.0);
    EXPECT_LE(flight.worst_release, 1.0);
    split += flight.all.patches_split;
    merged += flight.all.patches_merged;
  }
  EXPECT_GT(split, 300u);
  EXPECT_GT(merged, 300u);
}

}  // namespace
}  // namespace palpate::test
