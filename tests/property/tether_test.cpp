// A node that is released, drawn and removed: momentum is exact, and energy never comes from nowhere.
#include "palpate/solve/tether_force.hpp"

#include <gtest/gtest.h>

#include "support/moving_bodies.hpp"
#include "support/soak.hpp"

namespace palpate::test {
namespace {

using Eigen::Vector3d;

/// Of free nodes, with the masses that the integrator has: 1 / impulse.
double kinetic_energy_after_kick(Moving& m) {
  double energy = 0.0;
  m.body.for_nodes([&](uint16_t n) {
    if (!is_free(m, n)) return;
    const double w = sim::to_double(m.solve->impulse[n]);
    energy +=
        (doubles(m.body.node().velocity[n]) + w * doubles(m.body.node().force[n])).squaredNorm() / (2.0 * w);
  });
  return energy;
}

/// One LSB of force here is worth so much kinetic energy.
double energy_of_an_lsb(Moving& m) {
  double sum = 0.0;
  m.body.for_nodes([&](uint16_t n) {
    if (!is_free(m, n)) return;
    const double w = sim::to_double(m.solve->impulse[n]);
    sum += (doubles(m.body.node().velocity[n]) + w * doubles(m.body.node().force[n])).lpNorm<1>();
  });
  return std::ldexp(sum, -Force::kFractionBits);
}

Tether tether_of(const Split& split, TetherKind kind, uint8_t ticks_left) {
  return Tether{split.node, split.ends, split.patch.tet[0], ticks_left, kind, 0};
}

/// In any state, held ends or not, at any time: an inelastic impulse. Held nodes stand still, or their motion
/// would drag the node along.
TEST(Release, SumsToZeroAndNeverAddsEnergy) {
  Random random(93);
  double worst = -1e9;
  uint32_t held_ends = 0;
  uint32_t released = 0;
  for (uint32_t round = 0; round < in_soak(10000u, 400u); ++round) {
    Moving m = moving_body(random, 0.3);
    const Split split = split_at_random(m, random);
    if (split.node == kNone || !is_free(m, split.node)) continue;
    ++released;
    m.body.for_nodes([&](uint16_t n) {
      if (!is_free(m, n)) m.body.node().velocity[n] = zero_vector<Velocity>();
      m.body.node().force[n] = fixed_vector<Force>(0.02 * random.unit() * random.vector());
    });
    m.body.node().velocity[split.node] += fixed_vector<Velocity>(2e-3 * random.unit() * random.vector());
    held_ends += is_free(m, split.ends[0]) && is_free(m, split.ends[1]) ? 0u : 1u;
    const auto before = m.body.node().force;
    const double energy = kinetic_energy_after_kick(m);
    TetherForces<MovingProfile> forces(m.body.forest(), *m.solve, kNone);
    forces.add(tether_of(split, TetherKind::kRelease, static_cast<uint8_t>(1 + random.below(kTetherTicks))),
               1);
    Vector3<Force> sum = zero_vector<Force>();
    for (const uint16_t n : {split.node, split.ends[0], split.ends[1]})
      sum += m.body.node().force[n] - before[n];
    ASSERT_EQ(sum, zero_vector<Force>());
    worst = std::max(worst, (kinetic_energy_after_kick(m) - energy) / energy_of_an_lsb(m));
  }
  std::printf("%u releases, %u at held ends: energy changes by at most %+.2f LSB of force\n", released,
              held_ends, worst);
  EXPECT_GT(released, 100u);
  EXPECT_GT(held_ends, 10u);
  EXPECT_LE(worst, 1.0);
}

/// At first the node keeps to the midpoint's motion but for 1/65, and lets go by and by.
TEST(Release, TakesAwayTheRateThatItSays) {
  Random random(94);
  for (uint32_t round = 0; round < 200; ++round) {
    Moving m = moving_body(random, 0.3);
    const Split split = split_at_random(m, random);
    if (split.node == kNone || !is_free(m, split.node)) continue;
    m.body.for_nodes([&](uint16_t n) { m.body.node().force[n] = zero_vector<Force>(); });
    m.body.node().velocity[split.node] += fixed_vector<Velocity>(1e-4 * random.vector());
    const auto rate = [&] {
      const auto after = [&](uint16_t n) {
        const double w = is_free(m, n) ? sim::to_double(m.solve->impulse[n]) : 0.0;
        return Vector3d(doubles(m.body.node().velocity[n]) + w * doubles(m.body.node().force[n]));
      };
      return Vector3d(after(split.node) - 0.5 * (after(split.ends[0]) + after(split.ends[1])));
    };
    const Vector3d u = rate();
    const auto ticks = static_cast<uint8_t>(1 + random.below(kTetherTicks));
    TetherForces<MovingProfile>(m.body.forest(), *m.solve, kNone)
        .add(tether_of(split, TetherKind::kRelease, ticks), 1);
    const double left = 1.0 / (1.0 + std::exp2(9.0 * (ticks - 1) / 31.0 - 3.0));
    const double lsb = std::ldexp(12.0, -Force::kFractionBits);  // of force, at the lightest
    const double of_k = std::ldexp(0.5, -16);
    ASSERT_LE((rate() - left * u).cwiseAbs().maxCoeff(), lsb + of_k * u.cwiseAbs().maxCoeff())
        << unsigned{ticks};
  }
}

/// One substep of the bar with nothing but elasticity and this tether.
void step(Moving& m, const Tether& tether, uint32_t remaining, const DrivenNode& driven) {
  const HoldMotions still = {RigidMotion::identity(), RigidMotion::identity()};
  ClampCounters clamps{0, 0, 0};
  const uint32_t substeps = m.model.dynamics.substeps;
  if (remaining == substeps) {
    Tethers<MovingProfile> tethers{};
    tethers.add(tether);
    aim_ends(m.body.forest(), m.model.dynamics, still, driven, *m.solve, tethers);
  }
  (void)m.body.evaluate<Observe::kNo>();
  TetherForces<MovingProfile>(m.body.forest(), *m.solve, driven.node)
      .add(tether, (tether.ticks_left - 1u) * substeps + remaining);
  if (remaining == substeps) {
    integrate_first(m.body.forest(), m.model.dynamics, still, driven, *m.solve, clamps);
  } else {
    integrate_next(m.body.forest(), m.model.dynamics, driven.node, *m.solve, clamps);
  }
}

Vector3d offset(Moving& m, const Split& split) {
  const auto& x = m.body.node().position;
  return doubles(x[split.node]) - 0.5 * (doubles(x[split.ends[0]]) + doubles(x[split.ends[1]]));
}

/// A node somewhere near its edge, the body in free motion, or one end grasped, or on the held face: after
/// its ticks it is at the midpoint but for the drag that the tether does not foresee.
TEST(Draw, BringsTheNodeToTheMidpoint) {
  Random random(95);
  double worst = 0.0;
  uint32_t drawn = 0;
  for (uint32_t round = 0; round < in_soak(3000u, 150u); ++round) {
    Moving m = moving_body(random, 0.0);
    m.body.for_nodes(
        [&](uint16_t n) { m.body.node().velocity[n] = fixed_vector<Velocity>(1e-4 * random.vector()); });
    const Split split = split_at_random(m, random);
    if (split.node == kNone || !is_free(m, split.node)) continue;
    ++drawn;
    m.body.node().position[split.node] += fixed_vector<Position>(2e-3 * random.vector());
    Tether tether = tether_of(split, TetherKind::kDraw, kTetherTicks);
    const bool grasped = random.below(3) == 0;
    const DrivenNode driven{grasped ? split.ends[random.below(2)] : kNone,
                            m.body.node().position[split.ends[0]]};
    DrivenNode still = driven;
    if (grasped) still.target = m.body.node().position[driven.node];
    for (; tether.ticks_left > 0; --tether.ticks_left) {
      for (uint32_t remaining = m.model.dynamics.substeps; remaining > 0; --remaining)
        step(m, tether, remaining, still);
    }
    worst = std::max(worst, offset(m, split).cwiseAbs().maxCoeff());
  }
  std::printf("%u nodes drawn: off their midpoints by at most %.1e edges\n", drawn, worst);
  EXPECT_GT(drawn, 50u);
  EXPECT_LE(worst, 2e-7);
}

/// m_a v_a + m/2 v before, (m_a + m/2) v_a' after, for each free end.
TEST(Absorb, KeepsMomentumAndNeverAddsEnergy) {
  Random random(96);
  double worst = 0.0;
  double worst_energy = -1e9;
  uint32_t kept = 0;
  for (uint32_t round = 0; round < in_soak(100000u, 2000u); ++round) {
    if (round % 20 == 0) random = Random(1000 + round);
    Moving m = moving_body(random, 0.3);
    const Split split = split_at_random(m, random);
    if (split.node == kNone) continue;
    const double scale = std::pow(random.unit(), 3) * 0.03;
    for (const uint16_t n : {split.node, split.ends[0], split.ends[1]}) {
      m.body.node().velocity[n] = fixed_vector<Velocity>(scale * random.vector());
    }
    const auto velocity = m.body.node().velocity;
    const double half = 0.5 * m.body.node().mass[split.node];
    absorb_momentum(m.body.forest(), *m.solve, split.node, split.ends);
    const Vector3d own = std::exp2(36) * doubles(velocity[split.node]);
    for (const uint16_t end : split.ends) {
      const Vector3d before = std::exp2(36) * doubles(velocity[end]);
      const Vector3d after = std::exp2(36) * doubles(m.body.node().velocity[end]);
      if (!is_free(m, end)) {
        ++kept;
        ASSERT_EQ(m.body.node().velocity[end], velocity[end]);
        continue;
      }
      const double mass = m.body.node().mass[end];
      const Vector3d exact = (mass * before + half * own) / (mass + half);
      const double bound = 0.5 + std::ldexp((own - before).cwiseAbs().maxCoeff(), -30);
      worst = std::max(worst, (after - exact).cwiseAbs().maxCoeff() / bound);
      const double gain = 0.5 * (mass + half) * after.squaredNorm() -
                          0.5 * (mass * before.squaredNorm() + half * own.squaredNorm());
      worst_energy = std::max(worst_energy, gain / ((mass + half) * (after.lpNorm<1>() + 1.0)));
    }
  }
  std::printf("absorbed: velocities off by %.3f of their bound, energy up by %.3f LSB of velocity\n", worst,
              worst_energy);
  EXPECT_LE(worst, 1.0);
  EXPECT_LE(worst_energy, 0.51);
  EXPECT_GT(kept, 10u);
}

}  // namespace
}  // namespace palpate::test
