#include "plant/hand.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace palpate::plant {
namespace {

const Eigen::Vector3d kHere(0.2, 0.0, -0.1);
const Eigen::Vector3d kThere(0.2, 0.03, -0.12);

std::vector<Knot> wavy_samples() {
  std::vector<Knot> samples;
  samples.reserve(101);
  for (int i = 0; i <= 100; ++i) {
    const double t = 0.01 * i;
    samples.push_back({t, {0.2 + 0.01 * std::sin(7 * t), 0.02 * std::cos(5 * t), -0.1 + 0.01 * t}});
  }
  return samples;
}

/// Velocity against central differences of the position, and no jump in either.
void expect_smooth(const Intention& intention, double from, double to, double most_acceleration) {
  constexpr double kStep = 1e-4;
  for (double t = from; t < to; t += kStep) {
    const Intent now = intention.at(t);
    const Eigen::Vector3d mean = (intention.at(t + kStep).position - now.position) / kStep;
    ASSERT_LT((mean - now.velocity).norm(), most_acceleration * kStep) << t;
  }
}

TEST(ScriptedIntention, GoesFromKnotToKnotAndRestsThere) {
  const Intention intention = Intention::scripted({{1.0, kHere}, {2.0, kThere}, {4.0, kHere}});
  for (const auto& [time, place] :
       {std::pair{0.0, kHere}, std::pair{1.0, kHere}, std::pair{2.0, kThere}, std::pair{9.0, kHere}}) {
    EXPECT_LT((intention.at(time).position - place).norm(), 1e-15) << time;
    EXPECT_LT(intention.at(time).velocity.norm(), 1e-15) << time;
  }
  EXPECT_LT((intention.at(3.0).position - 0.5 * (kHere + kThere)).norm(), 1e-15);
  // Least jerk peaks at 15/8 of the mean speed.
  EXPECT_NEAR(intention.at(1.5).velocity.norm(), 1.875 * (kThere - kHere).norm(), 1e-12);
  expect_smooth(intention, 0.5, 4.5, 0.3);
}

TEST(ScriptedIntention, HoldsAndPressesFromKnotToKnot) {
  const Intention intention =
      Intention::scripted({{0.0, kHere, true, 0}, {1.0, kHere, true, 1}, {2.0, kHere, false, 0}});
  EXPECT_EQ(intention.at(0.999).buttons, 0);
  EXPECT_EQ(intention.at(1.0).buttons, 1);
  EXPECT_TRUE(intention.at(1.999).holds);
  EXPECT_FALSE(intention.at(2.0).holds);
  EXPECT_FALSE(intention.at(7.0).holds);
}

TEST(RecordedIntention, PassesThroughItsSamplesSmoothly) {
  const std::vector<Knot> samples = wavy_samples();
  const Intention intention = Intention::recorded(samples);
  for (const Knot& sample : samples) {
    EXPECT_LT((intention.at(sample.time).position - sample.position).norm(), 1e-12);
  }
  // Within the first and last piece the end's slope is one-sided; between them it is smooth.
  expect_smooth(intention, 0.0, 0.99, 2.0);
  const double t = 0.505;
  const Eigen::Vector3d exact(0.2 + 0.01 * std::sin(7 * t), 0.02 * std::cos(5 * t), -0.1 + 0.01 * t);
  EXPECT_LT((intention.at(t).position - exact).norm(), 1e-7);
}

TEST(AnIntention, RefusesWhatHasNoOrder) {
  EXPECT_THROW(Intention::scripted({}), std::invalid_argument);
  EXPECT_THROW(Intention::scripted({{1.0, kHere}, {1.0, kThere}}), std::invalid_argument);
  EXPECT_THROW(Intention::recorded({{1.0, kHere}}), std::invalid_argument);
  EXPECT_THROW(Intention::recorded({{1.0, kHere}, {0.5, kThere}}), std::invalid_argument);
}

TEST(Noise, HasTheSameBitsEverywhere) {
  Noise noise(0);
  EXPECT_EQ(noise.bits(), 0xe220a8397b1dcdafU);  // SplitMix64's published first numbers for seed 0
  EXPECT_EQ(noise.bits(), 0x6e789e6aa1b965f4U);
  Noise a(5);
  Noise b(5);
  Noise c(6);
  const double first = a.normal();
  EXPECT_EQ(first, b.normal());
  EXPECT_NE(first, c.normal());
}

TEST(Noise, IsNearlyNormal) {
  Noise noise(7);
  constexpr int kDraws = 200000;
  double sum = 0.0;
  double square_sum = 0.0;
  int within_one = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = noise.normal();
    sum += x;
    square_sum += x * x;
    within_one += std::fabs(x) < 1.0 ? 1 : 0;
  }
  EXPECT_NEAR(sum / kDraws, 0.0, 0.01);
  EXPECT_NEAR(square_sum / kDraws, 1.0, 0.02);
  EXPECT_NEAR(static_cast<double>(within_one) / kDraws, 0.683, 0.01);
}

TEST(HandLoad, IsTheSpringAndNothingWhenReleased) {
  Hand hand(HandParameters{}, Intention::scripted({{0.0, kHere, true, 1}, {1.0, kThere, false, 1}}));
  hand.begin_tick(1e-3);
  const TipLoad held = hand.load(0.5);
  EXPECT_EQ(held.stiffness, 300.0);
  EXPECT_EQ(held.damping, 5.0);
  EXPECT_EQ(held.mass, 0.1);
  EXPECT_EQ(held.force, Eigen::Vector3d::Zero());
  EXPECT_LT((held.anchor - 0.5 * (kHere + kThere)).norm(), 1e-15);
  EXPECT_EQ(hand.buttons(0.5), 1);
  const TipLoad released = hand.load(1.0);
  EXPECT_EQ(released.stiffness, 0.0);
  EXPECT_EQ(released.damping, 0.0);
  EXPECT_EQ(released.mass, 0.0);
  EXPECT_EQ(hand.buttons(1.0), 0);
}

TEST(HandTremor, HasItsSizeAndBandwidth) {
  HandParameters parameters;
  parameters.tremor = {0.2, 10.0, 3};
  Hand hand(parameters, Intention::scripted({{0.0, kHere}}));
  double square_sum = 0.0;
  double product_sum = 0.0;
  double last = 0.0;
  constexpr int kTicks = 400000;
  for (int i = 0; i < kTicks; ++i) {
    hand.begin_tick(1e-3);
    const double force = hand.load(0.0).force[1];
    square_sum += force * force;
    product_sum += force * last;
    last = force;
  }
  EXPECT_NEAR(std::sqrt(square_sum / kTicks), 0.2, 0.01);
  // One tick apart, a first-order low pass of 10 Hz correlates by exp(-2 pi 10 / 1000).
  EXPECT_NEAR(product_sum / square_sum, std::exp(-0.0628319), 0.005);
}

}  // namespace
}  // namespace palpate::plant
