// The scenario `touch`, played on this machine.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "hil/plant_simulation.hpp"
#include "palpate/safety/state.hpp"
#include "palpate/tick/state.hpp"
#include "recording/mapped_file.hpp"
#include "recording/replay.hpp"
#include "simulation/capacity.hpp"

namespace palpate::sim {
namespace {

struct TouchRow {
  Sample sample;
  safety::State state;
  double hand_force_n;
};

/// `touch` in profile small, whose one substep a tick is enough for level 3.
Scenario touch_scenario() {
  Scenario scenario = built_in_scenario("touch");
  scenario.profile = "small";
  scenario.model.level = 3;
  return scenario;
}

std::vector<TouchRow> play(Scenario scenario) {
  complete_scenario(scenario);
  fit_to_profile(scenario);
  std::vector<TouchRow> rows;
  TouchRow row{};
  const auto simulation = make_plant_simulation(scenario, [&row](const ClosedLoop& loop) {
    row.state = static_cast<safety::State>(loop.answer().safety_state);
    row.hand_force_n = loop.plant().truth().hand_force.norm();
  });
  for (bool goes_on = true; goes_on;) {
    goes_on = simulation->advance();
    row.sample = simulation->sample();
    rows.push_back(row);
  }
  EXPECT_EQ(simulation->failure(), std::nullopt);
  return rows;
}

const std::vector<TouchRow>& small_touch() {
  static const std::vector<TouchRow> rows = play(touch_scenario());
  return rows;
}

bool has(const TouchRow& row, TickFlag flag) { return (row.sample.flags & static_cast<uint32_t>(flag)) != 0; }

double norm(const std::array<double, 3>& v) { return std::hypot(v[0], v[1], v[2]); }

TEST(Touch, TouchesGraspsPullsAndLetsGo) {
  const auto& rows = small_touch();
  ASSERT_EQ(rows.size(), 6500u);
  uint32_t touching = 0;
  uint32_t grasping = 0;
  double pulled_mm = 0.0;
  for (const TouchRow& row : rows) {
    touching += has(row, TickFlag::kTouching) ? 1u : 0u;
    grasping += has(row, TickFlag::kGrasping) ? 1u : 0u;
    pulled_mm = std::max(pulled_mm, norm(row.sample.displacement_mm));
  }
  EXPECT_GT(touching, 500u);
  EXPECT_GT(grasping, 1500u);
  EXPECT_GT(pulled_mm, 20.0);
  EXPECT_FALSE(has(rows.back(), TickFlag::kGrasping));
  EXPECT_EQ(rows.back().state, safety::State::kActive);
  EXPECT_LT(norm(rows.back().sample.force_n), 1e-3);
}

/// A step of force that a hand feels is none of the body's: 20 mN is what a finger just notices.
TEST(Touch, HasNoStepOfForceButWhereContactBegins) {
  double largest_n = 0.0;
  std::array<double, 3> before{};
  bool was_touching = false;
  for (const TouchRow& row : small_touch()) {
    const auto& now = row.sample.force_n;
    const double step = norm({now[0] - before[0], now[1] - before[1], now[2] - before[2]});
    const bool begins = has(row, TickFlag::kTouching) && !was_touching;
    if (!begins) {
      ASSERT_LE(step, 1.001 * std::max(0.020, 0.05 * std::max(norm(now), norm(before)))) << row.sample.tick;
      largest_n = std::max(largest_n, step);
    }
    was_touching = has(row, TickFlag::kTouching);
    before = now;
  }
  std::printf("largest step of force in a tick: %.1f mN\n", largest_n * 1e3);
}

/// Before it is calibrated and enabled the device gives no torque, and then only what the ramp lets through.
TEST(Touch, HasNoTorqueBeforeItIsEnabled) {
  bool was_enabled = false;
  for (const TouchRow& row : small_touch()) {
    was_enabled = was_enabled || row.state == safety::State::kRamping;
    if (was_enabled) continue;
    ASSERT_EQ(row.sample.motor_codes, (std::array<uint16_t, 3>{2048, 2048, 2048})) << row.sample.tick;
  }
  EXPECT_TRUE(was_enabled);
}

/// What `--record` keeps is enough to have the run again, to the bit.
TEST(Touch, IsTheSameAgainFromItsRecording) {
  Scenario scenario = touch_scenario();
  scenario.ticks = 3300;
  scenario.record = ::testing::TempDir() + fmt::format("palpate-touch-{}.plp", getpid());
  complete_scenario(scenario);
  fit_to_profile(scenario);
  const auto simulation = make_plant_simulation(scenario, [](const ClosedLoop&) {});
  while (simulation->advance()) {
  }
  simulation->end();
  const recording::MappedFile file(scenario.record);
  std::filesystem::remove(scenario.record);
  const recording::ReplayReport report =
      recording::replay(file.bytes(), {}, [](const recording::Mismatch& mismatch) {
        ADD_FAILURE() << "tick " << mismatch.tick << ", " << mismatch.what;
        return false;
      });
  EXPECT_EQ(report.finding.status, container::ReadStatus::kEnd);
  EXPECT_EQ(report.last_tick, 3300u);
  EXPECT_EQ(report.hash_points, 33u);
}

TEST(Touch, IsTheSameInEachRun) {
  const auto again = play(touch_scenario());
  ASSERT_EQ(again.size(), small_touch().size());
  for (std::size_t i = 0; i < again.size(); ++i) {
    ASSERT_EQ(again[i].sample.motor_codes, small_touch()[i].sample.motor_codes);
    ASSERT_EQ(again[i].sample.force_n, small_touch()[i].sample.force_n);
  }
}

}  // namespace
}  // namespace palpate::sim
