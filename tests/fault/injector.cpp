#include "injector.hpp"

#include "palpate/safety/motor_heat.hpp"

namespace palpate::fault {
namespace {

using safety::Condition;
using safety::ConditionSet;
using safety::EventSet;

void heat(Cycle& cycle, std::size_t motor, safety::Celsius celsius) {
  cycle.safety.motors.motors[motor].temperatures.winding = widen<safety::HeatSum::kFractionBits>(celsius);
}

/// To any other tet of the pool: a wild index would be a fault of the test's own memory.
void break_link(Cycle& cycle, uint32_t detail) {
  auto& forest = cycle.core.forest;
  Leaf& leaf = forest.leaf[detail % forest.leaf_count];
  uint16_t& link = leaf.neighbour[detail / 7 % 4];
  const auto other = static_cast<uint16_t>(detail / 29 % Forest<Small>::kTets);
  link = other == link ? kNone : other;
}

/// 6 cm aside, with 1500 N/m: beyond 2 m/s within some ticks.
void yank(Loop& loop, uint32_t detail) {
  constexpr double kAsideM = 0.06;
  const Eigen::Vector3d aside = detail / 3 % 2 == 0 ? Eigen::Vector3d::Unit(detail % 3)
                                                    : Eigen::Vector3d(-Eigen::Vector3d::Unit(detail % 3));
  plant::HandParameters strong;
  strong.stiffness = 1500.0;
  const std::vector<plant::Knot> there = {{0.0, loop.plant.truth().tip + kAsideM * aside}};
  loop.plant.hand_over(plant::Hand(strong, plant::Intention::scripted(there)));
}

void move_body(Cycle& cycle, uint32_t detail, bool back) {
  constexpr auto kAside = Position::ratio(5, 64);
  auto& origin = cycle.scene.device_origin[detail % 3];
  origin = back ? origin - kAside : origin + kAside;
}

}  // namespace

void Injector::operator()(TickCase& now, Loop& loop) {
  const uint32_t tick = loop.tick();
  if (tick + 1 == event_.start) before_ = now.sensors;
  if (tick >= event_.start && tick < event_.end()) spoil(now, loop, tick == event_.start);
  if (tick == event_.end()) mend(loop);
}

void Injector::spoil(TickCase& now, Loop& loop, bool is_first) {
  ConditionSet& reported = now.sensors.report.reported;
  safety::Parameters& parameters = loop.cycle.safety.parameters;
  switch (event_.kind) {
    case EventKind::kEmergencyStop:
      reported |= ConditionSet::of(Condition::kEmergencyStop);
      return;
    case EventKind::kAmplifierFault:
      reported |= ConditionSet::of(Condition::kAmplifierFault);
      return;
    case EventKind::kMeshLink:
      if (is_first) break_link(loop.cycle, event_.detail);
      return;
    case EventKind::kOverheated:
      return heat(loop.cycle, joint(), safety::Celsius::ratio(105, 1));
    case EventKind::kWarmMotors:
      return heat(loop.cycle, joint(), safety::Celsius::ratio(85, 1));
    case EventKind::kForceLimit:
      parameters.force.max_newtons = phantom::Newton::ratio(1, 10);
      return;
    case EventKind::kImpulseLimit:
      parameters.force.impulse_newtons_per_tick = phantom::Newton::ratio(2, 1000);
      return;
    case EventKind::kBodyMoved:
      if (is_first) move_body(loop.cycle, event_.detail, false);
      return;
    case EventKind::kYank:
      if (is_first) yank(loop, event_.detail);
      return;
    case EventKind::kGraspGlitch:
      now.sensors.grasp_button = !now.sensors.grasp_button;
      return;
    default:
      spoil_clockwork(now, loop);
      spoil_counts(now, is_first);
      request(now);
  }
}

void Injector::spoil_clockwork(TickCase& now, Loop& loop) {
  safety::TimingReport& timing = now.sensors.report.timing;
  switch (event_.kind) {
    case EventKind::kLostEdges:
      now.loses_edge = true;
      return;
    case EventKind::kLateCycles:
      now.is_late = true;
      return;
    case EventKind::kSkippedTicks:
      loop.timer += 1 + event_.detail % 3;
      timing.tick_number = loop.timer;
      return;
    case EventKind::kSilence:
      now.sensors.encoder_counts = before_.encoder_counts;
      now.sensors.grasp_button = before_.grasp_button;
      timing.message_number = before_.report.timing.message_number;
      return;
    default:
      return;
  }
}

void Injector::spoil_counts(TickCase& now, bool is_first) {
  int32_t& count = now.sensors.encoder_counts[joint()];
  const int32_t sign = event_.detail / 3 % 2 == 0 ? 1 : -1;
  switch (event_.kind) {
    case EventKind::kCountRange:
      count = sign * 40000;
      return;
    case EventKind::kCountJump:
      count += sign * 300;
      return;
    case EventKind::kCountStuck:
      if (is_first) before_ = now.sensors;
      count = before_.encoder_counts[joint()];
      return;
    default:
      return;
  }
}

void Injector::request(TickCase& now) const {
  EventSet& requests = now.sensors.report.requests;
  switch (event_.kind) {
    case EventKind::kDisable:
      requests |= EventSet::of(safety::Event::kDisable);
      return;
    case EventKind::kEnable:
      requests |= EventSet::of(safety::Event::kEnable);
      return;
    case EventKind::kCalibrate:
      requests |= EventSet::of(safety::Event::kCalibrationStarted);
      return;
    case EventKind::kAbortCalibration:
      requests |= EventSet::of(safety::Event::kCalibrationAborted);
      return;
    case EventKind::kAcknowledge:
      requests |= EventSet::of(safety::Event::kAcknowledge);
      return;
    default:
      return;
  }
}

void Injector::mend(Loop& loop) const {
  safety::Safety& safety = loop.cycle.safety;
  switch (event_.kind) {
    case EventKind::kOverheated:
    case EventKind::kWarmMotors:
      return heat(loop.cycle, joint(), safety.parameters.thermal.ambient);
    case EventKind::kForceLimit:
    case EventKind::kImpulseLimit:
      safety.parameters.force = device_parameters().force;
      return;
    case EventKind::kBodyMoved:
      return move_body(loop.cycle, event_.detail, true);
    case EventKind::kYank:
      loop.return_hand();
      return;
    default:
      return;
  }
}

}  // namespace palpate::fault
