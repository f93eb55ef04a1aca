// Hours of touch by hands that do anything: 10^7 ticks in ./dev soak. What a hand leaves behind must be
// nothing: no force at rest, no entry of a pool, no broken mesh.
#include <gtest/gtest.h>

#include <memory>

#include "hil/closed_loop.hpp"
#include "hil/host_controller.hpp"
#include "hil/touch_task.hpp"
#include "palpate/firmware/condition.hpp"
#include "palpate/tick/profiles.hpp"
#include "plant/premium.hpp"
#include "simulation/capacity.hpp"
#include "support/random.hpp"
#include "support/soak.hpp"

namespace palpate::sim {
namespace {

using Eigen::Vector3d;
using safety::State;
using Cycle = firmware::CycleState<Small>;

Scenario soak_scenario() {
  Scenario scenario = built_in_scenario("touch");
  scenario.profile = "small";
  scenario.model.level = 3;
  for (RegionParameters& region : scenario.model.regions) {
    region.least_level = 2;
    region.most_level = 4;
    region.density_kg_m3 = 1200.0;  // one substep a tick is stable there
  }
  complete_scenario(scenario);
  fit_to_profile(scenario);
  return scenario;
}

/// Now and then the emergency stop is pressed for a while, or an amplifier reports a fault.
class FaultyWorld final : public Controller {
 public:
  FaultyWorld(Controller& firmware, uint64_t seed) : firmware_(firmware), random_(seed) {}

  link::ActuatorsMessage answer(const link::SensorsMessage& sensors, const UserWish& wish) override {
    link::SensorsMessage seen = sensors;
    if (left_ == 0 && is_faulty && random_.below(20000) == 0) left_ = 1 + random_.below(300);
    if (left_ > 0) {
      --left_;
      ++fault_ticks;
      seen.emergency_stop_pressed = left_ % 2 == 0;
      seen.amplifier_fault = !seen.emergency_stop_pressed;
    }
    return firmware_.answer(seen, wish);
  }

  bool is_faulty = true;
  uint32_t fault_ticks = 0;

 private:
  Controller& firmware_;
  test::Random random_;
  uint32_t left_ = 0;
};

/// Moves to anywhere around the body and into it, slowly or with a jerk, grasping or not.
class RandomHand {
 public:
  RandomHand(const Scenario& scenario, uint64_t seed) : scenario_(scenario), random_(seed) {}

  /// What it does next, from where it means to be now: to a node, to take it in the next move, or anywhere.
  plant::Hand next(double now_s) {
    const Vector3d from = target_;
    buttons_ = is_at_node_ ? plant::kGraspButton : uint16_t{0};
    is_at_node_ = !is_at_node_ && random_.below(3) == 0;
    target_ = is_at_node_ ? Vector3d(node() + 0.003 * random_.vector())
                          : Vector3d(node() + 0.04 * random_.vector());
    const double duration = random_.below(8) == 0 ? 0.06 : 0.3 + 0.6 * random_.unit();
    return hand(now_s, from, duration);
  }
  plant::Hand go_home(double now_s) {
    const Vector3d from = target_;
    target_ = home();
    buttons_ = 0;
    is_at_node_ = false;
    return hand(now_s, from, 0.5);
  }

 private:
  static Vector3d home() { return plant::premium::tool_position(Vector3d::Zero()); }
  /// Of the scenario, in the device's frame.
  [[nodiscard]] Vector3d node() const {
    return Vector3d(in_device_m(scenario_.scene, node_from_centre_m(scenario_)).data());
  }
  plant::Hand hand(double now_s, const Vector3d& from, double duration) {
    plant::HandParameters parameters;
    parameters.tremor = {0.05, 10.0, random_.bits()};
    return {parameters, plant::Intention::scripted(
                            {{now_s, from, true, buttons_}, {now_s + duration, target_, true, buttons_}})};
  }

  const Scenario& scenario_;
  test::Random random_;
  Vector3d target_ = home();
  uint16_t buttons_ = 0;
  bool is_at_node_ = false;
};

struct AtRest {
  double force_n;
  double farthest_mm;  // of any node from its place
  uint32_t leaves, nodes, groups, tethers;
};

class Soak {
 public:
  explicit Soak(uint64_t seed)
      : scenario_(soak_scenario()),
        plant_({}, plant::Hand({}, plant::Intention::scripted(
                                       {{0.0, plant::premium::tool_position(Vector3d::Zero())}}))),
        firmware_(*state_, probe_),
        world_(firmware_, seed),
        loop_(plant_, world_),
        hand_(scenario_, seed + 1) {
    EXPECT_EQ(firmware::start(*state_, cycle_model(scenario_)), Status::kDone);
    EXPECT_TRUE(firmware::guard_device(*state_, safety::kPremium15Parameters));
  }

  /// So many ticks of anything, then home and rest.
  AtRest play(uint32_t ticks) {
    world_.is_faulty = true;
    for (uint32_t i = 0; i < ticks;) {
      const bool may_act = safety::is_torque_allowed(state_->safety.state);
      i += run(may_act ? hand_.next(plant_.seconds()) : hand_.go_home(plant_.seconds()), 1000);
    }
    world_.is_faulty = false;
    run(hand_.go_home(plant_.seconds()), 6000);
    return at_rest();
  }
  [[nodiscard]] const Cycle& state() const { return *state_; }
  [[nodiscard]] uint32_t fault_ticks() const { return world_.fault_ticks; }

  uint32_t touching = 0;
  uint32_t grasping = 0;

 private:
  uint32_t run(const plant::Hand& hand, uint32_t ticks) {
    plant_.hand_over(hand);
    for (uint32_t i = 0; i < ticks; ++i) {
      loop_.advance();
      const auto has = [this](TickFlag flag) {
        return (state_->output.flags & static_cast<uint32_t>(flag)) != 0;
      };
      touching += has(TickFlag::kTouching) ? 1u : 0u;
      grasping += has(TickFlag::kGrasping) ? 1u : 0u;
    }
    return ticks;
  }
  [[nodiscard]] AtRest at_rest() const {
    const Forest<Small>& forest = state_->core.forest;
    AtRest rest{0.0,
                0.0,
                forest.leaf_count,
                forest.nodes.used(),
                state_->core.front.groups.used(),
                state_->core.tethers.count};
    for (Eigen::Index i = 0; i < 3; ++i) {
      rest.force_n = std::max(rest.force_n,
                              std::abs(std::ldexp(state_->force[i].raw(), -phantom::Newton::kFractionBits)));
    }
    for (uint32_t i = 0; i < forest.nodes.used(); ++i) {
      const uint16_t node = forest.nodes.live(i);
      const auto away =
          to_mm(forest.node.position[node] - rest_position(forest.node.rest[node]), scenario_.model);
      const auto nowhere = to_mm(zero_vector<Position>(), scenario_.model);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        rest.farthest_mm = std::max(rest.farthest_mm, std::abs(away[axis] - nowhere[axis]));
      }
    }
    return rest;
  }

  Scenario scenario_;
  std::unique_ptr<Cycle> state_ = std::make_unique<Cycle>();
  firmware::NoProbe probe_;
  plant::Plant plant_;
  HostController<Small, firmware::NoProbe> firmware_;
  FaultyWorld world_;
  ClosedLoop loop_;
  RandomHand hand_;
};

TEST(TouchSoak, LeavesNothingBehind) {
  Soak soak(401);
  const AtRest first = soak.play(1000);
  const uint32_t ticks = test::in_soak(10'000'000u, 20'000u);
  const uint32_t between = test::in_soak(100'000u, 10'000u);
  AtRest last = first;
  while (soak.state().core.tick < ticks) {
    last = soak.play(between);
    ASSERT_TRUE(firmware::check_integrity(soak.state()).is_whole()) << soak.state().core.tick;
    ASSERT_EQ(soak.state().safety.state, State::kActive) << soak.state().core.tick;
    ASSERT_LT(last.force_n, 1e-3);
    ASSERT_LT(last.farthest_mm, 0.05);
    ASSERT_EQ(last.leaves, first.leaves);
    ASSERT_EQ(last.nodes, first.nodes);
    ASSERT_EQ(last.groups, first.groups);
    ASSERT_EQ(last.tethers, 0u);
  }
  EXPECT_GT(soak.touching, ticks / 200);
  EXPECT_GT(soak.grasping, ticks / 200);
  const auto& counters = soak.state().core.remesh;
  EXPECT_GT(counters.bisected, 0u);
  std::printf(
      "%u ticks, %u touching, %u grasping, %u with a fault; %u tets bisected, %u merged; at rest %.1e N, "
      "%.1e mm\n",
      soak.state().core.tick, soak.touching, soak.grasping, soak.fault_ticks(), counters.bisected,
      counters.merged, last.force_n, last.farthest_mm);
}

}  // namespace
}  // namespace palpate::sim
