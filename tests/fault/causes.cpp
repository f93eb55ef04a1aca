#include "causes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "plant/premium.hpp"
#include "plant/units.hpp"
#include "units.hpp"

namespace palpate::fault {
namespace {

Eigen::Vector3d newtons(const Vector3<phantom::Newton>& force) {
  return {sim::to_double(force[0]), sim::to_double(force[1]), sim::to_double(force[2])};
}

Eigen::Vector3d position_of(const phantom::Counts& counts, const phantom::Counts& at_reset) {
  const phantom::EncoderRatings& ratings = plant::premium::kEncoders;
  Eigen::Vector3d q;
  for (std::size_t joint = 0; joint < 3; ++joint) {
    const double per_turn = ratings.direction[joint] * ratings.counts_per_joint_turn_milli[joint] / 1000.0;
    q[static_cast<Eigen::Index>(joint)] = 2.0 * plant::kPi * (counts[joint] - at_reset[joint]) / per_turn;
  }
  return plant::premium::tool_position(q);
}

}  // namespace

uint32_t Causes::detection_ticks(Condition condition) const {
  if (condition == Condition::kEncoderStuck) return stuck_ticks_;
  if (condition == Condition::kInvariantBroken) return kInvariantTicks;
  return safety::answer(condition).detected_in_ticks;
}

safety::ConditionSet Causes::due() const {
  safety::ConditionSet due;
  for (uint32_t i = 0; i < safety::kConditionCount; ++i) {
    const auto condition = static_cast<Condition>(i);
    due |= safety::ConditionSet::of(condition, holds_.has(condition) && !unsure_.has(condition) &&
                                                   ticks_[i] >= detection_ticks(condition));
  }
  return due;
}

void Causes::see(const Loop& loop, bool looks_at_mesh) {
  const firmware::Sensors& sensors = loop.now.sensors;
  holds_ = unsure_ = safety::ConditionSet();
  stuck_ticks_ = loop.cycle.safety.parameters.motion.stuck_ticks;
  for (const Condition reported :
       {Condition::kEmergencyStop, Condition::kAmplifierFault, Condition::kWatchdog}) {
    note(reported, sensors.report.reported.has(reported));
  }
  watch_clockwork(sensors);
  watch_counts(sensors);
  watch_force(loop.cycle);
  watch_speed(loop.cycle, sensors);
  watch_heat(loop.cycle);
  if (looks_at_mesh) watch_mesh(loop.cycle);
  last_ = sensors;
  last_codes_ = loop.cycle.motor_codes;
  has_last_ = true;
}

void Causes::note(Condition condition, bool holds) {
  uint32_t& ticks = ticks_[static_cast<std::size_t>(condition)];
  ticks = holds ? ticks + 1 : 0;
  holds_ |= safety::ConditionSet::of(condition, holds);
}

void Causes::note_above(Condition condition, double value, double limit, double error) {
  note(condition, value > limit);
  unsure_ |= safety::ConditionSet::of(condition, std::abs(value - limit) < error);
}

void Causes::watch_clockwork(const firmware::Sensors& sensors) {
  const safety::TimingReport& timing = sensors.report.timing;
  const safety::TimingReport& last = last_.report.timing;
  is_new_ = !has_last_ || timing.message_number != last.message_number;
  note(Condition::kCommunicationLost, !is_new_);
  note(Condition::kCycleSlip, has_last_ && timing.tick_number - last.tick_number != 1);
  note(Condition::kTickOverrun, timing.is_late);
}

void Causes::watch_counts(const firmware::Sensors& sensors) {
  constexpr double kMovingAmperes = 0.32;
  constexpr int kJumpCounts = 205;
  bool is_out = false;
  bool is_jump = false;
  uint32_t still = 0;
  for (std::size_t joint = 0; joint < 3; ++joint) {
    const int32_t count = sensors.encoder_counts[joint];
    const int32_t way = std::abs(count - last_new_counts_[joint]);
    const double amperes = std::abs(last_codes_[joint] - 2048) * 5.5 / 2047.0;
    is_out = is_out || count < -32768 || count > 32767;
    is_jump = is_jump || way > kJumpCounts * static_cast<int>(silent_ticks_ + 1);
    const bool is_still = has_last_ && (!is_new_ || way == 0) && amperes > kMovingAmperes;
    still_ticks_[joint] = is_still ? still_ticks_[joint] + 1 : 0;
    still = std::max(still, still_ticks_[joint]);
  }
  note(Condition::kEncoderRange, is_out);
  note(Condition::kEncoderJump, has_last_ && is_new_ && is_jump);
  note(Condition::kEncoderStuck, still > 0);
  ticks_[static_cast<std::size_t>(Condition::kEncoderStuck)] = still;
  silent_ticks_ = is_new_ ? 0 : silent_ticks_ + 1;
  if (is_new_) last_new_counts_ = sensors.encoder_counts;
}

void Causes::watch_force(const Cycle& cycle) {
  constexpr double kError = 1e-7;
  const safety::ForceLimits& limits = cycle.safety.parameters.force;
  const Eigen::Vector3d force = newtons(cycle.force);
  if (forces_.empty()) forces_.assign(safety::kImpulseWindowTicks, force);
  note_above(Condition::kMaxForce, force.norm(), sim::to_double(limits.max_newtons), kError);
  const double in_tick = (force - forces_.back()).norm();
  const double in_window = (force - forces_.front()).norm();
  const double per_tick = sim::to_double(limits.impulse_newtons_per_tick);
  const double per_window = sim::to_double(limits.impulse_newtons_per_window);
  note_above(Condition::kForceImpulse, std::max(in_tick / per_tick, in_window / per_window), 1.0, 1e-4);
  forces_.pop_front();
  forces_.push_back(force);
}

/// Of the tool where the counts say that it is; a new calibration is no motion.
void Causes::watch_speed(const Cycle& cycle, const firmware::Sensors& sensors) {
  const double limit = sim::to_double(cycle.safety.parameters.motion.max_metres_per_tick);
  constexpr double kError = 1e-7;
  const Eigen::Vector3d position = position_of(phantom::in_range(sensors.encoder_counts), counts_at_reset_);
  const double moved = has_position_ ? (position - last_position_).norm() : 0.0;
  note_above(Condition::kMaxVelocity, moved, limit, kError);
  last_position_ = position;
  has_position_ = cycle.counts_at_reset == counts_at_reset_ && cycle.safety.velocity.is_primed;
  counts_at_reset_ = cycle.counts_at_reset;
}

void Causes::watch_heat(const Cycle& cycle) {
  const safety::ThermalLimits& limits = cycle.safety.parameters.thermal;
  double hottest = 0.0;
  for (const safety::WarmMotor& motor : cycle.safety.motors.motors) {
    hottest = std::max(hottest, sim::to_double(safety::celsius(motor.temperatures.winding)));
  }
  const double warm = sim::to_double(limits.warm);
  note(Condition::kMotorOverheated, hottest >= sim::to_double(limits.winding_limit));
  note(Condition::kWarmMotors, hottest > warm);
  // What has been hot stays so for a while.
  unsure_ |= safety::ConditionSet::of(Condition::kMotorOverheated,
                                      hottest > warm && !holds_.has(Condition::kMotorOverheated));
  unsure_ |= safety::ConditionSet::of(Condition::kWarmMotors,
                                      hottest >= sim::to_double(limits.release) && hottest <= warm);
}

/// A leaf that is wrong now, or was when its turn came.
void Causes::watch_mesh(const Cycle& cycle) {
  const Forest<Small>& forest = cycle.core.forest;
  bool is_broken = false;
  for (uint32_t i = 0; i < forest.leaf_count && !is_broken; ++i) {
    is_broken = check_leaf(forest, cycle.core.model.block, i) != Violation::kNothing;
  }
  note(Condition::kInvariantBroken, is_broken);
}

}  // namespace palpate::fault
