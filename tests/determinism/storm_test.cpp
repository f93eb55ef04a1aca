// What the hand of the storm does to the bar, through the whole cycle. In the checked build any operation
// that leaves its range aborts.
#include <gtest/gtest.h>

#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <memory>

#include "golden_body.hpp"
#include "palpate/firmware/condition.hpp"
#include "storm.hpp"
#include "support/soak.hpp"

namespace palpate::firmware {
namespace {

constexpr double kEdgeMm = 64.0;

using StormState = CycleState<golden::Profile>;

Vector3<Position> tool(const StormState& state) { return state.input.tool; }

Eigen::Vector3d in_mm(const Vector3<Position>& position) {
  Eigen::Vector3d mm;
  for (int axis = 0; axis < 3; ++axis) {
    mm[axis] = kEdgeMm * std::ldexp(position[axis].raw(), -Position::kFractionBits);
  }
  return mm;
}

/// What the hand did.
struct Deeds {
  double peak_speed_m_s = 0.0;
  uint32_t grasping = 0;  // ticks
  uint32_t grasps = 0;
  uint32_t pushed_through = 0;  // ticks in which a node's tool is in the bar, beyond its axis
};

class Storm {
 public:
  Storm() { EXPECT_EQ(start(*state_, kScenarioImage.model), Status::kDone); }

  void tick() {
    const ScriptRow row = hand_.next();
    const Eigen::Vector3d before = in_mm(tool(*state_));
    const Sensors sensors{{row.encoder_counts[0], row.encoder_counts[1], row.encoder_counts[2]},
                          (row.buttons & ScriptRow::kGraspButton) != 0};
    NoProbe probe;
    Actuators actuators{};
    cycle(*state_, sensors, actuators, probe);
    ASSERT_EQ(state_->fault, Fault::kNone);
    note(before);
  }

  void expect_whole() const {
    const Integrity integrity = check_integrity(*state_);
    ASSERT_EQ(integrity.mesh, Violation::kNothing) << "tick " << state_->core.tick;
    ASSERT_EQ(integrity.front, FrontViolation::kNothing) << "tick " << state_->core.tick;
    ASSERT_TRUE(integrity.tethers_hold) << "tick " << state_->core.tick;
  }

  [[nodiscard]] const StormState& state() const { return *state_; }
  [[nodiscard]] const Deeds& deeds() const { return deeds_; }

 private:
  void note(const Eigen::Vector3d& before) {
    const Eigen::Vector3d now = in_mm(tool(*state_));
    if (state_->core.tick > 1) deeds_.peak_speed_m_s = std::max(deeds_.peak_speed_m_s, (now - before).norm());
    const bool grasping = (state_->output.flags & static_cast<uint32_t>(TickFlag::kGrasping)) != 0;
    if (grasping) {
      ++deeds_.grasping;
      deeds_.grasps += grasped_ ? 0u : 1u;
      const LatticePoint rest = state_->core.forest.node.rest[state_->core.grasp.node];
      const bool in_bar = std::abs(now[0]) < kEdgeMm / 2 && std::abs(now[1]) < kEdgeMm / 2;
      if (in_bar && rest.x * now[0] + rest.y * now[1] < 0.0) ++deeds_.pushed_through;
    }
    grasped_ = grasping;
  }

  std::unique_ptr<StormState> state_ = std::make_unique<StormState>();
  golden::StormHand hand_{golden::kStormSeed};
  Deeds deeds_;
  bool grasped_ = false;
};

void print(const Storm& storm) {
  const StormState& state = storm.state();
  const Deeds& deeds = storm.deeds();
  const RemeshCounters& counters = state.core.remesh;
  std::printf("storm: %u ticks, state %016" PRIx64 "\n", state.core.tick, state_hash(state));
  std::printf("tool: up to %.3f m/s; %u grasps in %u ticks, pushed through the bar in %u\n",
              deeds.peak_speed_m_s, deeds.grasps, deeds.grasping, deeds.pushed_through);
  std::printf("tets bisected %u, merged %u; groups split %u, joined %u\n", counters.bisected, counters.merged,
              counters.groups_split, counters.groups_joined);
  std::printf("clamps: speed %u, position %u, strain %u; flags seen %03x\n", state.core.clamps.speed,
              state.core.clamps.position, state.core.clamps.strain, state.flags_seen);
  for (uint32_t i = 0; i < kPoolCount; ++i) {
    const auto pool = static_cast<Pool>(i);
    const PoolUse use = pool_use(state, pool);
    std::printf("%s: peak %u of %u, refused %u\n", pool_name(pool), use.peak, use.capacity, use.refused);
  }
}

/// The integer hand draws the rows of the image's script, which the targets play.
TEST(Storm, IsTheScriptOfTheImage) {
  golden::StormHand hand(golden::kStormSeed);
  ASSERT_EQ(kScenarioImage.row_count, golden::kStormTicks);
  for (uint32_t i = 0; i < kScenarioImage.row_count; ++i) {
    const ScriptRow row = hand.next();
    ASSERT_EQ(kScenarioImage.rows[i].encoder_counts, row.encoder_counts) << "row " << i;
    ASSERT_EQ(kScenarioImage.rows[i].buttons, row.buttons) << "row " << i;
  }
}

TEST(Storm, LeavesTheBarWhole) {
  const auto ticks = test::in_soak(1000000u, 1500u);
  Storm storm;
  for (uint32_t i = 1; i <= ticks; ++i) {
    ASSERT_NO_FATAL_FAILURE(storm.tick());
    if (i % 97 == 0) {
      ASSERT_NO_FATAL_FAILURE(storm.expect_whole());
    }
    if (test::is_soak() && i % 100000 == 0) print(storm);
  }
  ASSERT_NO_FATAL_FAILURE(storm.expect_whole());
  print(storm);
  const RemeshCounters& counters = storm.state().core.remesh;
  EXPECT_GT(counters.bisected, ticks / 40);
  EXPECT_GT(counters.merged, ticks / 40);
  EXPECT_GT(counters.groups_split, ticks / 100);
  EXPECT_GT(counters.groups_joined, ticks / 100);
  EXPECT_GT(storm.deeds().grasping, ticks / 10);
  EXPECT_GT(storm.deeds().pushed_through, ticks / 100);
  EXPECT_GT(storm.deeds().peak_speed_m_s, 0.8);
  EXPECT_LE(storm.deeds().peak_speed_m_s, 1.0);
}

}  // namespace
}  // namespace palpate::firmware
