#include "palpate/solve/integrate.hpp"

#include <gtest/gtest.h>

#include "support/bodies.hpp"
#include "support/forests.hpp"
#include "support/random.hpp"

namespace palpate::test {
namespace {

using SmallProfile = WithFullCorotation<Small>;
using Eigen::Vector3d;

const HoldMotions kStill = {RigidMotion::identity(), RigidMotion::identity()};

/// Random elastic-looking forces on every node.
void push(Forest<SmallProfile>& forest, Random& random, double strength) {
  for (uint32_t i = 0; i < forest.nodes.used(); ++i) {
    forest.node.force[forest.nodes.live(i)] = fixed_vector<Force>(strength * random.vector());
  }
}

class Integrate : public testing::TestWithParam<int> {
 protected:
  Integrate() {
    sim::ModelParameters parameters = coarse_bar(GetParam() > 5 ? 10.0 : 1000.0, GetParam());
    parameters.held = sim::HeldEnds::kBoth;
    state_ = started<SmallProfile>(compile_model(parameters));
  }

  void run_tick(const HoldMotions& motions, const DrivenNode& driven) {
    const auto forces = [&] { push(state_->forest, random_, 0.1); };
    advance<SmallProfile::kSubsteps>(
        state_->model.dynamics, forces, forces, [&](uint32_t) { set_out(motions, driven); },
        [&](uint32_t) {
          integrate_next(state_->forest, state_->model.dynamics, driven.node, state_->solve, state_->clamps);
        });
  }

  /// A substep of free nodes.
  void integrate() { set_out(kStill, DrivenNode{kNone, zero_vector<Position>()}); }

  void set_out(const HoldMotions& motions, const DrivenNode& driven) {
    integrate_first(state_->forest, state_->model.dynamics, motions, driven, state_->solve, state_->clamps);
  }

  [[nodiscard]] uint16_t free_node() const {
    for (uint32_t i = 0; i < state_->forest.nodes.used(); ++i) {
      if (state_->solve.control[state_->forest.nodes.live(i)] == NodeControl::kFree)
        return state_->forest.nodes.live(i);
    }
    return kNone;
  }

  Random random_{101};
  std::unique_ptr<State<SmallProfile>> state_;
};

TEST_P(Integrate, HeldNodesNeverMove) {
  for (int i = 0; i < 50; ++i) run_tick(kStill, DrivenNode{kNone, zero_vector<Position>()});
  uint32_t held = 0;
  uint32_t moved = 0;
  for (uint32_t i = 0; i < state_->forest.nodes.used(); ++i) {
    const uint16_t node = state_->forest.nodes.live(i);
    const bool at_rest = state_->forest.node.position[node] == rest_position(state_->forest.node.rest[node]);
    if (state_->solve.control[node] == NodeControl::kFree) {
      moved += at_rest ? 0u : 1u;
      continue;
    }
    ++held;
    EXPECT_TRUE(at_rest);
    EXPECT_EQ(state_->forest.node.velocity[node], zero_vector<Velocity>());
  }
  EXPECT_EQ(held, 18u);  // 9 on each end face at level 3
  EXPECT_EQ(moved, state_->forest.nodes.used() - held);
}

TEST_P(Integrate, MovedHoldsArriveExactly) {
  const Vector3d axis = random_.direction();
  for (int i = 1; i <= 30; ++i) {
    const double angle = 0.002 * i;
    HoldMotions motions = {RigidMotion::identity(), RigidMotion::identity()};
    for (RigidMotion& motion : motions) {
      motion.rotation = fixed_matrix<RotationEntry>(Eigen::AngleAxisd(angle, axis).toRotationMatrix());
      motion.translation = fixed_vector<Position>(0.003 * random_.vector());
    }
    run_tick(motions, DrivenNode{kNone, zero_vector<Position>()});
    for (uint32_t k = 0; k < state_->forest.nodes.used(); ++k) {
      const uint16_t node = state_->forest.nodes.live(k);
      const NodeControl control = state_->solve.control[node];
      if (control == NodeControl::kFree) continue;
      const RigidMotion& motion = motions[control == NodeControl::kHeldByFirst ? 0 : 1];
      ASSERT_EQ(state_->forest.node.position[node], motion(state_->forest.node.rest[node]));
    }
  }
  EXPECT_EQ(state_->clamps.speed, 0u);
}

/// Also a held node, if it is the one that is driven; on the way it goes in equal steps.
TEST_P(Integrate, DrivenNodeArrivesExactly) {
  for (const uint16_t node : {free_node(), state_->forest.leaf[0].node[0]}) {
    for (int i = 0; i < 20; ++i) {
      const Vector3<Position> from = state_->forest.node.position[node];
      const Vector3<Position> target = from + fixed_vector<Position>(0.01 * random_.vector());
      run_tick(kStill, DrivenNode{node, target});
      ASSERT_EQ(state_->forest.node.position[node], target);
      const Vector3d step = doubles(target) - doubles(from);
      const Vector3d v = doubles(state_->forest.node.velocity[node]) * GetParam();
      ASSERT_LT((v - step).cwiseAbs().maxCoeff(), GetParam() * std::ldexp(2.0, -27));
    }
  }
}

/// v <- v + f / m - alpha v and x <- x + v, against doubles: half an LSB each, and of the damping a 32nd
/// more.
TEST_P(Integrate, FreeNodesFollowTheFormula) {
  const uint16_t node = free_node();
  for (int i = 0; i < 500; ++i) {
    push(state_->forest, random_, 0.3);
    const Vector3d x = doubles(state_->forest.node.position[node]);
    const Vector3d v = doubles(state_->forest.node.velocity[node]);
    const Vector3d f = doubles(state_->forest.node.force[node]);
    integrate();
    const Vector3d next_v = v + f * sim::to_double(state_->solve.impulse[node]) -
                            sim::to_double(state_->model.dynamics.mass_damping) * v;
    const Vector3d got_v = doubles(state_->forest.node.velocity[node]);
    ASSERT_LE((got_v - next_v).cwiseAbs().maxCoeff(), std::ldexp(0.5 + 1.0 / 32 + 1e-3, -36));
    const Vector3d got_x = doubles(state_->forest.node.position[node]);
    ASSERT_LE((got_x - x - got_v).cwiseAbs().maxCoeff(), std::ldexp(0.5, -27));
    const Vector3d ahead = got_x + sim::to_double(state_->model.dynamics.stiffness_damping) * got_v;
    ASSERT_LE((doubles(state_->solve.force_position[node]) - ahead).cwiseAbs().maxCoeff(),
              std::ldexp(0.502, -27));
  }
}

TEST_P(Integrate, ClampsSpeedAndPositionAndCountsThem) {
  const uint16_t node = free_node();
  state_->forest.node.velocity[node] = fixed_vector<Velocity>(Vector3d(0.031, 0, 0));
  push(state_->forest, random_, 0.0);
  state_->forest.node.force[node][0] = sim::to_fixed<Force>(60.0);
  state_->solve.impulse[node] = sim::to_fixed<Impulse>(7.9);
  integrate();
  EXPECT_EQ(state_->clamps.speed, 1u);
  EXPECT_GE(state_->forest.node.velocity[node][0], Velocity::from_raw(0x7fff8000));
  state_->forest.node.position[node][0] = kPositionLimit - Position::from_raw(1);
  integrate();
  EXPECT_EQ(state_->clamps.position, 1u);
  EXPECT_EQ(state_->forest.node.position[node][0], kPositionLimit);
  EXPECT_LE(state_->solve.force_position[node][0], sim::to_fixed<Position>(4.0));
}

/// A driven node whose target is too far for one tick goes there as fast as it can, and arrives later.
TEST_P(Integrate, ADrivenNodeTooFarAwayIsFlaggedAndArrivesLater) {
  const uint16_t node = free_node();
  const Vector3<Position> target =
      state_->forest.node.position[node] + fixed_vector<Position>(Vector3d(0.6, -0.3, 0.1));
  run_tick(kStill, DrivenNode{node, target});
  EXPECT_GT(state_->clamps.speed, 0u);
  EXPECT_FALSE(state_->forest.node.position[node] == target);
  for (int i = 0; i < 30; ++i) run_tick(kStill, DrivenNode{node, target});
  EXPECT_TRUE(state_->forest.node.position[node] == target);
}

INSTANTIATE_TEST_SUITE_P(Substeps, Integrate, testing::Values(1, 2, 3, 4, 5, 8));

TEST(NodeControl, IsByPlaceAndTheFirstRegionWins) {
  const HeldRegions held = {LatticeBox{{0, 0, 0}, {2, 2, 2}}, LatticeBox{{2, 0, 0}, {4, 2, 2}}};
  EXPECT_EQ(control_of({1, 1, 1}, held), NodeControl::kHeldByFirst);
  EXPECT_EQ(control_of({2, 1, 1}, held), NodeControl::kHeldByFirst);
  EXPECT_EQ(control_of({3, 1, 1}, held), NodeControl::kHeldBySecond);
  EXPECT_EQ(control_of({5, 1, 1}, held), NodeControl::kFree);
  EXPECT_EQ(control_of({1, 1, 3}, held), NodeControl::kFree);
}

/// To half an LSB, wherever on the lattice.
TEST(RigidMotion, IsTheRotationAndTheTranslation) {
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::AngleAxisd turn(3.0 * random.unit(), random.direction());
    const RigidMotion motion{fixed_matrix<RotationEntry>(turn.toRotationMatrix()),
                             fixed_vector<Position>(random.vector())};
    const auto steps = [&] { return static_cast<int16_t>(random.below(129)) - 64; };
    const LatticePoint at{static_cast<int16_t>(steps()), static_cast<int16_t>(steps()),
                          static_cast<int16_t>(steps())};
    const Vector3d expected =
        doubles(motion.rotation) * doubles(rest_position(at)) + doubles(motion.translation);
    EXPECT_LE((doubles(motion(at)) - expected).cwiseAbs().maxCoeff(), std::ldexp(0.5 + 1e-6, -27));
  }
}

}  // namespace
}  // namespace palpate::test
