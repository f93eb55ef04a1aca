// The defaults are the published figures, and unusable parameters are told apart.
#include "palpate/safety/parameters.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "every.hpp"

namespace palpate::safety {
namespace {

using test::number;

TEST(Parameters, DefaultToThePublishedFigures) {
  const Parameters p;
  EXPECT_NEAR(number(p.force.max_newtons), 8.5, 1e-8);
  EXPECT_NEAR(1 / number(p.ramp.step_per_tick), 2000, 0.01);
  EXPECT_NEAR(number(p.ramp.contact_newtons), 0.2, 1e-8);
  EXPECT_EQ(p.ramp.free_ticks, 4);
  const double span = number(p.thermal.winding_limit) - number(p.thermal.ambient);
  EXPECT_NEAR((number(p.thermal.warm) - number(p.thermal.ambient)) / span, 0.7, 1e-8);
  EXPECT_NEAR((number(p.thermal.release) - number(p.thermal.ambient)) / span, 0.5, 1e-8);
  EXPECT_NEAR(number(p.thermal.decay_per_tick), 0.999, 1e-9);
  EXPECT_NEAR(number(p.thermal.peak_amperes), 5.5, 1e-8);
  EXPECT_NEAR(number(p.thermal.continuous_amperes), 1.24, 1e-8);
  EXPECT_NEAR(p.motion.max_counts_per_tick, 41 * 5, 0.5);
  EXPECT_TRUE(is_usable(p));
}

TEST(Parameters, ThatNoMonitorCanKeepAreNotUsable) {
  const std::vector<std::function<void(Parameters&)>> spoil = {
      [](Parameters& p) { p.ramp.step_per_tick = kNoForce; },
      [](Parameters& p) { p.ramp.step_per_tick = Gain::max(); },
      [](Parameters& p) { p.ramp.contact_newtons = phantom::Newton::from_raw(0); },
      [](Parameters& p) { p.force.max_newtons = -p.force.max_newtons; },
      [](Parameters& p) { p.force.impulse_newtons_per_tick = phantom::Newton::from_raw(0); },
      [](Parameters& p) { p.force.impulse_newtons_per_window = phantom::Newton::from_raw(-1); },
      [](Parameters& p) { p.motion.max_metres_per_tick = phantom::Metre::from_raw(-1); },
      [](Parameters& p) { p.motion.max_counts_per_tick = 0; },
      [](Parameters& p) { p.motion.moving_amperes = Ampere::from_raw(-1); },
      [](Parameters& p) { p.motion.stuck_ticks = 0; },
      [](Parameters& p) { p.timing.silent_ticks = 0; },
      [](Parameters& p) { p.timing.overrun_ticks = 0; },
      [](Parameters& p) { p.thermal.ambient = p.thermal.release; },
      [](Parameters& p) { p.thermal.ambient = -p.thermal.ambient; },
      [](Parameters& p) { p.thermal.release = p.thermal.warm; },
      [](Parameters& p) { p.thermal.winding_limit = p.thermal.warm; },
      [](Parameters& p) { p.thermal.continuous_amperes = Ampere::from_raw(0); },
      [](Parameters& p) { p.thermal.continuous_amperes = Ampere::ratio(6, 1); },
      [](Parameters& p) { p.thermal.rise_amperes_per_tick = Ampere::from_raw(0); },
      [](Parameters& p) { p.thermal.decay_per_tick = Q<0, 31>::from_raw(0); }};
  for (std::size_t i = 0; i < spoil.size(); ++i) {
    Parameters p;
    spoil[i](p);
    EXPECT_FALSE(is_usable(p)) << i;
  }
}

}  // namespace
}  // namespace palpate::safety
