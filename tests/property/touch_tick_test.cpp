// Contact in whole ticks: a ball pressed into a bar and released, drawn along it, on a mesh that changes, and
// at 1 m/s.
#include <gtest/gtest.h>

#include "support/remeshing.hpp"
#include "support/soak.hpp"
#include "support/surfaces.hpp"

namespace palpate::test {
namespace {

using Eigen::Vector3d;
using FullBar = WithFullCorotation<CuboidDense>;

constexpr double kRadius = 0.125;  // 8 mm
constexpr double kSide = 0.5;      // of the bar

ContactRules ball(double stiffness, double friction) {
  ContactRules rules{};
  rules.radius = sim::to_fixed<Position>(kRadius);
  rules.stiffness = sim::to_fixed<Coupling>(stiffness);
  rules.damping = sim::to_fixed<Coupling>(stiffness);
  rules.friction = sim::to_fixed<Fraction>(friction);
  rules.force_limit = Force::ratio(1, 1);
  rules.slew = sim::to_fixed<Force>(stiffness / 16.0);
  rules.passivity = PassivityRules{1u << 20, Coupling::ratio(1000, 1)};
  return rules;
}

/// The paper's bar held at both ends, as light as there, so that it follows a hand without swinging.
Model light_bar(double friction) {
  sim::ModelParameters parameters = coarse_bar(10.0, 4);
  parameters.held = sim::HeldEnds::kBoth;
  parameters.mass_damping_per_s = 30.0;
  Model model = compile_model(parameters);
  model.contact = ball(1.0, friction);
  return model;
}

TickInput tool_at(const Vector3d& x) {
  TickInput input = input_at_rest();
  input.tool = fixed_vector<Position>(x);
  return input;
}

/// From 0 to 1 without a jump of speed.
double smooth(double t) { return 0.5 - 0.5 * std::cos(3.14159265358979 * std::clamp(t, 0.0, 1.0)); }

/// In the middle of a side, by 0.2 edges (13 mm), and back out.
TEST(TouchTick, APressedBallIsPushedBackAndLetGo) {
  const auto state = started<FullBar>(light_bar(0.0));
  constexpr int kWay = 1000;
  constexpr double kCreep = 4e-6;  // of 0.04
  double force = 0.0;
  double most = 0.0;
  double largest_step = 0.0;
  double across = 0.0;
  for (int i = 0; i <= 2 * kWay; ++i) {
    const double depth = 0.25 * smooth(i <= kWay ? i / double{kWay} : 2.0 - i / double{kWay}) - 0.05;
    const TickOutput output = tick_once(*state, tool_at({kSide + kRadius - depth, 0.03, 0.05}));
    const Vector3d reaction = doubles(output.reaction);
    const double step = reaction[0] - force;
    force = reaction[0];
    ASSERT_GE(force, 0.0) << i;
    // But for what creeps while the ball is nearly still.
    if (i <= kWay) {
      ASSERT_GE(step, -kCreep) << i;
    } else {
      ASSERT_LE(step, kCreep) << i;
    }
    largest_step = std::max(largest_step, std::abs(step));
    across = std::max(across, std::abs(reaction[1]) + std::abs(reaction[2]));
    most = std::max(most, force);
    ASSERT_EQ(has(output, TickFlag::kTouching) || force > 0.0, has(output, TickFlag::kTouching)) << i;
    ASSERT_FALSE(has(output, TickFlag::kContactsFull));
  }
  std::printf("pressed by 0.2 edges: up to %.5f, by up to %.6f a tick, %.5f across\n", most, largest_step,
              across);
  EXPECT_EQ(force, 0.0);
  EXPECT_FALSE(state->contact.is_touching);
  EXPECT_GT(most, 0.02);
  EXPECT_LT(largest_step, 1.0 * 0.25 * 3.15 / 2 / kWay * 2.0);  // of a rigid surface, twice
}

/// The tool's impulse is the body's: what the bar's nodes get is what the tool does not, in every substep.
TEST(TouchTick, MomentumGoesFromToolToBody) {
  sim::ModelParameters parameters = coarse_bar(1000.0, 2);
  parameters.held = sim::HeldEnds::kNone;
  parameters.mass_damping_per_s = 0.0;
  Model model = compile_model(parameters);
  model.contact = ball(4.0, 0.5);
  const auto state = started<FullBar>(model);
  const auto momentum = [&] {
    Vector3d sum = Vector3d::Zero();
    for (uint32_t i = 0; i < state->forest.nodes.used(); ++i) {
      sum += doubles(state->forest.node.velocity[i]) / sim::to_double(state->solve.impulse[i]);
    }
    return sum;
  };
  double mass = 0.0;
  for (uint32_t i = 0; i < state->forest.nodes.used(); ++i)
    mass += 1.0 / sim::to_double(state->solve.impulse[i]);
  Vector3d given = Vector3d::Zero();
  for (int i = 0; i < 300; ++i) {
    tick_once(*state, tool_at({kSide + kRadius + 0.01 - 0.001 * i, 0.0005 * i, 0.0}));
    given -= 2.0 * doubles(state->contact.force);
  }
  const double error = (momentum() - given).cwiseAbs().maxCoeff() / mass;
  std::printf("a free bar was given %.2e of velocity, to %.1f LSB\n", given.norm() / mass,
              std::ldexp(error, 36));
  EXPECT_LT(given[0], -0.5);
  EXPECT_LE(error, 600 * std::ldexp(0.5, -36));  // rounding of velocities
}

/// Drawn along the side at a constant depth.
TEST(TouchTick, SlidesWithoutAndWithFriction) {
  double drag[2] = {0.0, 0.0};
  for (const double mu : {0.0, 0.4}) {
    const auto state = started<FullBar>(light_bar(mu));
    double largest = 0.0;
    double before = 0.0;
    for (int i = 0; i <= 2500; ++i) {
      const double depth = 0.15 * smooth(i / 500.0) - 0.05;
      const double along = 0.6 * smooth((i - 800) / 1500.0);
      const TickOutput output = tick_once(*state, tool_at({kSide + kRadius - depth, 0.03, -0.3 + along}));
      const Vector3d force = doubles(output.reaction);
      const double cone = mu * force.dot(doubles(state->contact.normal));
      const Vector3d n = doubles(state->contact.normal);
      if (!has(output, TickFlag::kBraking)) {
        ASSERT_LE((force - force.dot(n) * n).norm(), cone + 1e-4) << i;
      }
      largest = std::max(largest, std::abs(force[2] - before));
      before = force[2];
      if (i == 1500) drag[mu > 0.0 ? 1 : 0] = -force[2] / force[0];
    }
    std::printf("mu = %.1f: drag over press %.3f, by up to %.5f a tick\n", mu, drag[mu > 0.0 ? 1 : 0],
                largest);
    EXPECT_LT(largest, 0.01);
  }
  // The surface is dented, so there is some drag without friction.
  EXPECT_LT(std::abs(drag[0]), 0.25);
  EXPECT_GT(drag[1], drag[0] + 0.2);
}

/// Refined where it is dented and coarsened when it is not: loads stay on live nodes, the mesh whole, and no
/// tick's force jumps.
TEST(TouchTick, TheMeshMayChangeUnderTheTool) {
  sim::ModelParameters parameters = remeshing_bar();
  parameters.held = sim::HeldEnds::kBoth;
  parameters.regions[0] = {500.0, 0.45, 1000.0, 1, 6};
  parameters.remesh.stretch_split = 0.02;
  Model model = compile_model(parameters);
  model.contact = ball(4.0, 0.3);
  const auto state = started<CuboidDense>(model);
  uint32_t under = 0;
  double before = 0.0;
  double largest = 0.0;
  for (int i = 0; i < 6000; ++i) {
    const double depth = 0.2 * smooth(std::abs(std::remainder(i / 1000.0, 2.0))) - 0.03;
    const double along = 0.5 * std::sin(i * 6.283 / 6000);
    const uint32_t changes = state->remesh.bisected + state->remesh.merged;
    const TickOutput output = tick_once(*state, tool_at({kSide + kRadius - depth, 0.03, along}));
    for (uint32_t k = 0; k < state->contact.load.count; ++k) {
      ASSERT_TRUE(state->forest.nodes.is_live(state->contact.load.node[k])) << i;
    }
    const double force = output.reaction[0].raw() * kForceLsb;
    largest = std::max(largest, std::abs(force - before));
    before = force;
    const bool has_changed = state->remesh.bisected + state->remesh.merged != changes;
    under += has_changed && has(output, TickFlag::kTouching) ? 1u : 0u;
    if (i % 50 == 0) {
      ASSERT_NO_FATAL_FAILURE(expect_whole(*state)) << i;
    }
  }
  std::printf(
      "%u ticks with changes under the tool, force changes by up to %.5f a tick; bisected %u, merged %u\n",
      under, largest, state->remesh.bisected, state->remesh.merged);
  EXPECT_GT(under, 50u);
  EXPECT_GT(state->remesh.merged, 50u);
  EXPECT_LT(largest, 0.02);
}

/// 1 m/s through a bar of 64 mm and out of the other side: the proxy stays on the side it came from as long
/// as the bar is between, and a ball is seen in the tick in which it arrives.
TEST(TouchTick, AToolAt1MetrePerSecondDoesNotTunnel) {
  for (const double radius : {1.0 / 32.0, 1.0 / 8.0}) {
    Model model = light_bar(0.0);
    model.contact.radius = sim::to_fixed<Position>(radius);
    const auto state = started<FullBar>(model);
    bool has_touched = false;
    for (int i = 0; i < 90; ++i) {
      const double x = 0.7 - i / 64.0;
      const TickOutput output = tick_once(*state, tool_at({x, 0.03, 0.05}));
      const bool arrives = x < kSide + radius;
      if (!has_touched) {
        ASSERT_EQ(has(output, TickFlag::kTouching), arrives) << i;
      }
      has_touched = has_touched || arrives;
      const Vector3d proxy = doubles(state->contact.proxy);
      ASSERT_LT(winding_number(faces_of(state->forest), proxy), 0.5) << i;
      ASSERT_LE(state->contact.faces_examined, kPushes * FullBar::kContactCandidates);
      ASSERT_GE(output.reaction[0].raw(), 0) << i;
      if (x < -0.4) {
        ASSERT_TRUE(has(output, TickFlag::kTouching)) << i;
        ASSERT_GT(proxy[0], x + radius) << i;
      }
    }
  }
}

/// A tool that holds on to a node does not touch beside it. One that lets go within the skin of the body
/// touches nothing until it has left it, and its force goes by no more than the slew a tick.
TEST(TouchTick, AGraspIsNotAContact) {
  Model model = light_bar(0.0);
  model.grasp_reach = Position::ratio(1, 4);
  const auto state = started<FullBar>(model);
  TickInput input = tool_at({0.52, 0.52, 0.0});
  input.close_grasp = true;
  for (int i = 0; i < 50; ++i) {
    const TickOutput output = tick_once(*state, input);
    ASSERT_TRUE(has(output, TickFlag::kGrasping));
    ASSERT_FALSE(has(output, TickFlag::kTouching));
    ASSERT_EQ(state->contact.force, zero_vector<Force>());
  }
  input.close_grasp = false;
  Vector3d before = Vector3d::Zero();
  const auto go_on = [&](const Vector3d& tool) {
    const TickOutput output = tick_once(*state, tool_at(tool));
    EXPECT_LE((doubles(output.reaction) - before).norm(), 1.0 / 16.0 + 8 * kForceLsb);
    before = doubles(output.reaction);
    return has(output, TickFlag::kTouching);
  };
  for (int i = 0; i < 50; ++i) ASSERT_FALSE(go_on({0.52, 0.52, 0.0}));
  EXPECT_EQ(before.norm(), 0.0);
  const auto beside = [](int i) { return Vector3d(0.52 + 0.005 * i, 0.52 + 0.005 * i, 0.0); };
  for (int i = 0; i < 50; ++i) ASSERT_FALSE(go_on(beside(i)));
  for (int i = 50; i >= 0; --i) (void)go_on(beside(i));
  EXPECT_TRUE(state->contact.is_touching);
  EXPECT_GT(before.norm(), 0.0);
}

/// A look for a node to hold on to that finds none is instead of the contact's step: it stays as it was for
/// that tick, and goes on in the next.
TEST(TouchTick, AGraspInVainLeavesTheContactForATick) {
  Model model = light_bar(0.0);
  model.grasp_reach = Position::ratio(1, 64);
  const auto state = started<FullBar>(model);
  const auto tool = [](int i) {
    return tool_at({kSide + kRadius + 0.05 - 0.1 * smooth(i / 500.0), 0.03, 0.05});
  };
  for (int i = 0; i < 400; ++i) (void)tick_once(*state, tool(i));
  ASSERT_TRUE(state->contact.is_touching);
  const Contact before = state->contact;
  TickInput input = tool(400);
  input.close_grasp = true;
  const TickOutput output = tick_once(*state, input);
  EXPECT_TRUE(has(output, TickFlag::kTouching));
  EXPECT_FALSE(has(output, TickFlag::kGrasping));
  EXPECT_EQ(state->contact.proxy, before.proxy);
  EXPECT_EQ(state->contact.force, before.force);
  input = tool(401);
  input.close_grasp = true;
  (void)tick_once(*state, input);
  EXPECT_TRUE(state->contact.is_touching);
  EXPECT_NE(state->contact.proxy, before.proxy);
  EXPECT_NE(state->contact.force, before.force);
}

/// The tool's force may change slowly; the body's must not, or it would be pushed long after it has turned. A
/// body that swings against a tool that is held comes to rest.
TEST(TouchTick, ABodyThatSwingsAgainstAHeldToolComesToRest) {
  sim::ModelParameters parameters = coarse_bar(1000.0, 2);
  parameters.mass_damping_per_s = 1.0;
  Model model = compile_model(parameters);
  model.contact = ball(4.0, 0.2);
  model.contact.slew = Force::ratio(1, 2000);
  const auto state = started<FullBar>(model);
  for (uint32_t i = 0; i < state->forest.nodes.used(); ++i) {
    const uint16_t node = state->forest.nodes.live(i);
    const double height = doubles(rest_position(state->forest.node.rest[node]))[2] + 1.5;
    state->forest.node.velocity[node][0] = sim::to_fixed<Velocity>(0.0001 * height * height);
  }
  const auto swing = [&](int ticks) {
    double most = 0.0;
    for (int i = 0; i < ticks; ++i) {
      (void)tick_once(*state, tool_at({kSide + kRadius, 0.0, 1.3}));
      for (uint32_t k = 0; k < state->forest.nodes.used(); ++k) {
        const uint16_t node = state->forest.nodes.live(k);
        most = std::max(most, doubles(state->forest.node.velocity[node]).norm());
      }
    }
    return most;
  };
  const double first = swing(1000);
  (void)swing(5000);
  const double last = swing(1000);
  std::printf("swing against a held tool: %.6f edges a substep, after 6 s %.6f\n", first, last);
  EXPECT_LT(last, 0.1 * first);
}

/// What the hand has put in is never less than what it got back, with a coupling that would be unstable
/// alone.
TEST(TouchTick, EnergyIsNeverBelowZeroWhileTheControllerMay) {
  Random random(341);
  sim::ModelParameters parameters = coarse_bar(1000.0, 1);
  parameters.held = sim::HeldEnds::kBoth;
  Model model = compile_model(parameters);
  model.contact = ball(16.0, 0.3);
  model.contact.passivity.ceiling = 64;
  model.contact.slew = Force::ratio(2, 1);  // a slew would stand in the controller's way
  const auto state = started<FullBar>(model);
  double given = 0.0;
  uint32_t braking = 0;
  Vector3d tool(kSide + kRadius, 0.03, 0.0);
  Vector3d rate = Vector3d::Zero();
  for (int i = 0; i < 4000; ++i) {
    rate = 0.95 * rate + 0.001 * random.vector() +
           0.02 * (Vector3d(kSide + kRadius - 0.05, 0.0, 0.0) - tool) * 0.05;
    const Vector3d before = tool;
    tool += rate;
    const auto fixed = [](const Vector3d& x) { return doubles(fixed_vector<Position>(x)); };
    const TickOutput output = tick_once(*state, tool_at(tool));
    if (i > 0) given -= doubles(output.reaction).dot(fixed(tool) - fixed(before));
    braking += has(output, TickFlag::kBraking) ? 1u : 0u;
    if (state->reaction.passivity.energy.raw() < 0) {
      ASSERT_LT((fixed(tool) - fixed(before)).norm(), 1e-3) << "only where a limit stood in the way";
    }
  }
  std::printf("the hand put in %.5f, braked in %u ticks\n", given, braking);
  EXPECT_GT(braking, 20u);
  EXPECT_GT(given, 0.0);
}

/// A body without a tool's radius does not know of contact: same bits wherever the tool is.
TEST(TouchTick, WithoutARadiusNothingTouches) {
  Model model = light_bar(0.0);
  model.contact.radius = Position::from_raw(0);
  const auto state = started<FullBar>(model);
  for (int i = 0; i < 50; ++i) {
    const TickOutput output = tick_once(*state, tool_at({0.45, 0.0, 0.01 * i}));
    ASSERT_EQ(output.flags, 0u);
    ASSERT_EQ(output.reaction, zero_vector<Force>());
  }
  for (uint32_t i = 0; i < state->forest.nodes.used(); ++i) {
    EXPECT_EQ(state->forest.node.position[i], rest_position(state->forest.node.rest[i]));
  }
}

}  // namespace
}  // namespace palpate::test
